#pragma once
// Facts about a scene for `heml explain` (app/commands/explain.cpp), which prints them as text and JSON: what the
// engine runs for it, which features are unused, and advice.
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

/// The elements of one region.
struct RegionFacts {
  int number = 0;
  std::string name;  ///< empty: it has none
  std::size_t tets = 0;
  double volume = 0;  ///< m³, at rest
};

/// A term of a material's energy (elastic/group_term.hpp), or another contribution to its forces.
struct TermFacts {
  std::string name;    ///< law, volume_term, viscosity, relaxation, plasticity, nodal_pressure, springs
  std::string detail;  ///< readable text
};

/// A material that has elements.
struct MaterialFacts {
  std::optional<int> region;  ///< empty: the default entry
  KernelInfo kernel;
  std::vector<TermFacts> terms;
  double density = 0;        ///< kg/m³
  SmallStrainModuli rest{};  ///< Pa; where parameters are fields, of their means
  double poisson = 0;        ///< of the small-strain moduli; 0 of springs
};

/// Why one element limits explicit steps: its shape and material compared with the median element's.
struct LimitFacts {
  enum class Cause { none, sliver, small, stiff };  ///< none: no element stands out
  Cause cause = Cause::none;
  int element = -1;                              ///< mesh-file order; −1: springs
  double dihedral = 0;                           ///< degrees, smallest
  double height = 0, median_height = 0;          ///< m, smallest of an element: 3 V over the largest face
  double wave_speed = 0, median_wave_speed = 0;  ///< m/s, of pressure waves at rest
};
/// "none", "sliver", "small", "stiff".
const char* name_of(LimitFacts::Cause cause);

/// A tool of the scene, or one that its events use.
struct ToolFacts {
  std::string name;                       ///< table, self-contact, tearing; grasp, probe, pin, suture, tables, cut, ...
  std::string detail;                     ///< readable text
  int times = 0;                          ///< number of events that start its use
  std::optional<double> first{}, last{};  ///< s, of its use by events; empty: present from the start
};

/// Work done once, before the first step.
struct StartupWork {
  std::string what;
  double seconds;
};

struct OmittedFeature {
  std::string feature, why;
};

/// Something that costs speed or accuracy, and a remedy.
struct Advice {
  std::string about;  ///< stable keyword for scripts: locking, volume_stiffness, sliver, real_time, step, implicit, ...
  std::string text, remedy;
};

struct Explanation {
  std::string file, name;
  std::optional<BareMeshChoices> chosen;  ///< of a bare mesh
  WorldSetup setup;
  QualityReport quality;
  WorldFacts world;
  std::vector<RegionFacts> regions;  ///< by number
  std::vector<MaterialFacts> materials;
  LimitFacts limit;
  std::vector<ToolFacts> tools;
  std::vector<StartupWork> startup;
  std::vector<OmittedFeature> omitted_features;
  std::vector<Advice> advice;
};

/// Loads the scene, makes its world and collects the facts, without a step; implicit and static scenes factor their
/// matrix once. Throws InputError as load_world() does.
Explanation explain(const Scene& scene);

/// Parts of an Explanation that follow from the others.
std::vector<ToolFacts> tools_of(const Scene& scene, const WorldSetup& setup);
std::vector<OmittedFeature> omitted_features_of(const Scene& scene, const WorldSetup& setup, const WorldFacts& facts);
std::vector<Advice> advice_on(const Explanation& explained);

}  // namespace heml
