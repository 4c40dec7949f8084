#pragma once
// What a scene makes the engine run, what it leaves out, and what is worth a person's attention: facts as values, which
// `heml explain` (app/commands/explain.cpp) puts into words and JSON.
//
//   scene ──► mesh ──► setup ──► world ──► WorldFacts (world/facts.hpp) ──┐
//     each stage timed ───────────────────────────────────────────────────┴──► Explanation
#include <heml/mesh/quality.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/world/facts.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml {

/// A term of the energy of a material's elements (elastic/group_term.hpp), or what acts beside them.
struct TermFacts {
  std::string name;    ///< law, volume_term, viscosity, relaxation, plasticity, nodal_pressure, springs
  std::string detail;  ///< for people
};

/// A material that has elements.
struct MaterialFacts {
  std::optional<int> region;  ///< none: the default entry
  KernelInfo kernel;
  std::vector<TermFacts> terms;
  double density = 0;        ///< kg/m³
  SmallStrainModuli rest{};  ///< Pa, at rest; where parameters are fields, of their means
  double poisson = 0;        ///< at rest; of springs 0, like the ground state
};

/// Why one element limits explicit steps: its shape and its material beside the median element's.
struct LimitFacts {
  enum class Cause { none, sliver, small, stiff };  ///< none: no element stands out
  Cause cause = Cause::none;
  int element = -1;                              ///< mesh-file order; −1: springs
  double dihedral = 0;                           ///< degrees, its smallest
  double height = 0, median_height = 0;          ///< m, smallest: 3 V over the largest face
  double wave_speed = 0, median_wave_speed = 0;  ///< m/s, of pressure waves at rest
};
/// "none", "sliver", "small", "stiff".
const char* name_of(LimitFacts::Cause cause);

/// A tool that stands in the scene, or that its script takes up.
struct ToolFacts {
  std::string name;                       ///< table, self-contact, tearing; grasp, probe, pin, suture, tables, cut, ...
  std::string detail;                     ///< for people
  int times = 0;                          ///< that the script takes it up
  std::optional<double> first{}, last{};  ///< s, of its use by the script; none: it stands there from the start
};

/// Work done once, before the first step.
struct StartupWork {
  std::string what;
  double seconds;
};

struct OmittedFeature {
  std::string feature, why;
};

/// Something that costs speed or exactness, and what would help.
struct Advice {
  std::string about;  ///< a stable word for scripts: locking, volume_stiffness, sliver, real_time, step, implicit, ...
  std::string text, remedy;
};

struct Explanation {
  std::string file, name;
  WorldSetup setup;  ///< what the world was made of
  QualityReport quality;
  WorldFacts world;
  std::vector<MaterialFacts> materials;
  LimitFacts limit;
  std::vector<ToolFacts> tools;
  std::vector<StartupWork> startup;
  std::vector<OmittedFeature> omitted_features;
  std::vector<Advice> advice;
};

/// Loads the scene and asks its world. Takes no step; an implicit or static one factors its matrix once. Throws
/// InputError as load_world().
Explanation explain(const Scene& scene);

/// The parts of it that follow from the rest.
std::vector<ToolFacts> tools_of(const Scene& scene, const WorldSetup& setup);
std::vector<OmittedFeature> omitted_features_of(const Scene& scene, const WorldSetup& setup, const WorldFacts& facts);
std::vector<Advice> advice_on(const Explanation& explained);

}  // namespace heml
