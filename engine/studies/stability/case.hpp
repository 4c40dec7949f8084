#pragma once
// A case of the stability study: a measured value with a limit, for every law, integrator and precision that it applies
// to (its variants). To add one: write `Outcome name(const Trial&)` in the file of its kind, declare it below, and give
// it a line in cases.cpp. Every case has a scene in assets/scenes/extreme, so that users can open, watch and record it.
// Cases of motion and statics read theirs; cases of forces make the same states in C++.
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

/// Law, integrator and precision of one run of a case.
struct CaseVariant {
  std::string law;                       ///< one of study_laws()
  std::optional<Integrator> integrator;  ///< none: forces only, no motion
  bool single = false;                   ///< float instead of double
  bool operator==(const CaseVariant&) const = default;
};
std::string to_text(const CaseVariant& variant);  ///< "neo_hookean verlet float"

/// A finite value alone is no pass.
enum class Verdict {
  stable,     ///< holds
  recovered,  ///< holds, after recovery of a collapsed body
  inverted,   ///< some elements are inverted at the end
  diverged,   ///< stopped early, or the value is not finite
  wrong,      ///< finite, but above the limit, or another requirement is not met
  unsolvable  ///< stopped, or with inverted elements, where the problem is proven to have no solution
};
const char* verdict_name(Verdict verdict);

struct Outcome {
  double value = 0;          ///< the measured value; smaller is better
  int inverted = 0;          ///< inverted elements at the end
  long recoveries = 0;       ///< number of recoveries
  std::string stopped = {};  ///< why the run stopped early; empty: it did not
  std::string broken = {};   ///< another requirement of the case that is not met, in words; empty: none
  std::string note = {};     ///< remark for the report
  std::string proof = {};    ///< that there is no solution where the run ended (no_solution.hpp); empty: none
};
Verdict judge(const Outcome& outcome, double limit);
/// Whether it is an end that the table may have: stable, recovered, or proven to have no solution.
bool is_sound(Verdict verdict);

/// Combines two runs of one variant: the larger value, all failures, the last note; a proof if all failures have one.
Outcome worse(const Outcome& a, const Outcome& b);

/// Changes the forces (3 #V, N) of a body of one material at positions x (3 #V, m) to simulate a fault.
using ForceFault = std::function<void(const TetMesh& mesh, const Material& material, const std::vector<double>& x,
                                      std::vector<double>& forces)>;

/// The input of a case. Faults are for tests, which check that cases detect them; empty: none.
struct Trial {
  CaseVariant variant;
  bool quick = false;
  std::function<void(WorldSetup&)> world_fault = {};
  ForceFault force_fault = {};

  /// A scene of assets/scenes/extreme with the variant's law (at the small-strain moduli of the scene's), integrator
  /// and precision, on one thread. Throws InputError.
  WorldSetup setup(const std::string& scene) const;
  /// make_world() of the setup after world_fault, if any.
  std::unique_ptr<World> world(WorldSetup setup) const;
};

using CaseFunction = Outcome (*)(const Trial&);

struct Case {
  int number;            ///< in the list of cases
  const char* name;      ///< a few words
  const char* holds;     ///< when the case holds, one sentence
  const char* measured;  ///< what is measured
  double limit;          ///< of the value, in double
  double float_limit;    ///< of the value, in float; NaN: not run in float
  std::span<const std::string_view> laws;
  std::vector<Integrator> integrators;   ///< empty: forces only
  std::vector<std::string_view> scenes;  ///< files in assets/scenes/extreme, without ".json"
  CaseFunction run;
  double limit_of(const CaseVariant& variant) const { return variant.single ? float_limit : limit; }
};

/// All cases, in the order of their numbers.
std::span<const Case> cases();
const Case& case_numbered(int number);

/// All variants of a case. quick: one or two laws of each case with an integrator.
std::vector<CaseVariant> variants_of(const Case& c, bool quick);

/// Laws of the study, in the order of columns: all but the paper's laws with stress at rest.
std::span<const std::string_view> study_laws();
std::span<const std::string_view> continua();  ///< without springs

// forces.cpp
Outcome force_is_energy_gradient(const Trial&);
Outcome stiffness_is_force_gradient(const Trial&);
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
// motion.cpp
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
