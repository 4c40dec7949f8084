#pragma once
// A case of the stability study: a question with a number for an answer, asked of every law, integrator and precision
// for which it makes sense (a Way). To add one: write `Outcome name(const Trial&)` in the file of its kind, declare it
// below, and give it a line in cases.cpp. A case that is a scene reads its file from assets/scenes/extreme, so that
// what is measured is what people can open and watch.
//
//   cases()  ×  variants_of(case)  ──►  Trial ──► case.run ──► Outcome ──► judge ──► Verdict
#include <functional>
#include <heml/world/world.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace heml::stability {

/// What a case is run with.
struct CaseVariant {
  std::string law;                       ///< one of study_laws()
  std::optional<Integrator> integrator;  ///< none: forces alone, nothing moves
  bool single = false;                   ///< float instead of double
  bool operator==(const CaseVariant&) const = default;
};
std::string to_text(const CaseVariant& variant);  ///< "neo_hookean verlet float"

/// "No NaN" is not among them.
enum class Verdict {
  stable,     ///< holds
  recovered,  ///< holds, after the engine brought the body back
  inverted,   ///< elements are inside out at the end
  diverged,   ///< stopped, ran away or never ended
  wrong       ///< finite, and not what it has to be
};
const char* verdict_name(Verdict verdict);

struct Outcome {
  double value = 0;          ///< what the case measures: the smaller the better
  int inverted = 0;          ///< elements, at the end
  long recoveries = 0;       ///< that were needed
  std::string stopped = {};  ///< why the world halted; empty: it did not
  std::string broken = {};   ///< another demand of the case that was not met, in words; empty: none
  std::string note = {};     ///< for people
};
Verdict judge(const Outcome& outcome, double limit);

/// The outcome of several runs of one way: the larger figure, all that went wrong, the last note.
Outcome worse(const Outcome& a, const Outcome& b);

/// Forces (3 #V, N) of a body of one material at positions x (3 #V), as a fault may change them.
using ForceFault = std::function<void(const TetMesh& mesh, const Material& material, const std::vector<double>& x,
                                      std::vector<double>& forces)>;

/// What a case gets. Faults are for tests, which see to it that cases notice; empty: none.
struct Trial {
  CaseVariant variant;
  bool quick = false;
  std::function<void(WorldSetup&)> world_fault = {};
  ForceFault force_fault = {};

  /// A scene of assets/scenes/extreme made of the way's law (with the moduli at rest of the scene's own), stepped by
  /// its integrator in its precision, on one thread. Throws InputError.
  WorldSetup setup(const std::string& scene) const;
  /// make_world(), with the fault, if any.
  std::unique_ptr<World> world(WorldSetup setup) const;
};

using CaseFunction = Outcome (*)(const Trial&);

struct Case {
  int number;            ///< in the list of cases
  const char* name;      ///< a few words
  const char* holds;     ///< what counts as holding, one sentence
  const char* measured;  ///< what is measured
  double limit;          ///< of the figure, in double
  double float_limit;    ///< NaN: not asked in float
  std::span<const std::string_view> laws;
  std::vector<Integrator> integrators;   ///< empty: forces alone
  std::vector<std::string_view> scenes;  ///< files in assets/scenes/extreme, without ".json"
  CaseFunction run;
  double limit_of(const CaseVariant& variant) const { return variant.single ? float_limit : limit; }
};

/// All of them, in the order of their numbers.
std::span<const Case> cases();
const Case& case_numbered(int number);

/// Every way a case is asked. quick: a few laws of each.
std::vector<CaseVariant> variants_of(const Case& c, bool quick);

/// Laws of the study, in the order of columns: all but those of stress at rest, which the paper's tables print.
std::span<const std::string_view> study_laws();
std::span<const std::string_view> continua();  ///< without springs

// forces.cpp
Outcome force_is_slope_of_energy(const Trial&);
Outcome stiffness_is_slope_of_force(const Trial&);
Outcome tension_form_is_gradient_form(const Trial&);
Outcome rigid_motion_far_away(const Trial&);
Outcome sums_of_forces(const Trial&);
Outcome exponential_far_out(const Trial&);
Outcome equal_stretches(const Trial&);
// statics.cpp
Outcome patch(const Trial&);
Outcome flattened(const Trial&);
Outcome stretched_and_pressed(const Trial&);
Outcome stiffness_ratio(const Trial&);
Outcome nearly_incompressible(const Trial&);
// accuracy.cpp
Outcome order_of_verlet(const Trial&);
Outcome order_of_tr_bdf2(const Trial&);
Outcome energy_drift(const Trial&);
Outcome stiff_and_settled(const Trial&);
Outcome density_ratio(const Trial&);
Outcome jittered_steps(const Trial&);
// prescribed_motion.cpp
Outcome beam_drop(const Trial&);
Outcome no_energy_from_nothing(const Trial&);
Outcome no_energy_from_budgets(const Trial&);
Outcome half_a_turn(const Trial&);
Outcome two_turns(const Trial&);
Outcome sliver(const Trial&);
Outcome soak(const Trial&);
// collapse.cpp
Outcome collapsed(const Trial&);
Outcome mirrored(const Trial&);
Outcome yanked(const Trial&);
// changes.cpp
Outcome cut_away(const Trial&);
Outcome law_switched(const Trial&);
// invariance.cpp
Outcome permuted(const Trial&);
Outcome other_units(const Trial&);
Outcome any_number_of_threads(const Trial&);

}  // namespace heml::stability
