// The scenes of the accuracy study, their meshes, and the range of methods tried on each.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <studies/accuracy_study.hpp>
#include <studies/bench_bodies.hpp>

namespace heml {
namespace {

/// A scene file of the study and its variation.
struct Entry {
  const char* file;  ///< below assets/
  SceneStudyOptions options;
  double weight;                  ///< s it took when written: its part of the progress
  int halvings = 0;               ///< number of uniform subdivisions
  double young = 0, poisson = 0;  ///< beams: Pa and Poisson's ratio; 0: those of the file
  std::string_view law = {};      ///< bench_material() of this law; empty: that of the file
};

constexpr const char *beam_file = "studies/accuracy/beam.json", *cube_file = "studies/accuracy/cube.json";
constexpr SceneStudyOptions thorough{}, brief{Breadth::brief, true, 50000}, own{Breadth::brief, false, 0};

constexpr Entry quick_entries[] = {{beam_file, {Breadth::brief, true, 20000}, 20},
                                   {"studies/accuracy/twist.json", own, 10}};

constexpr Entry full_entries[] = {
    {beam_file, thorough, 60},
    {"scenes/kidney_pull.json", thorough, 300},
    {"studies/accuracy/twist.json", brief, 60},
    {"studies/accuracy/inclusion.json", brief, 60},
    {"studies/accuracy/fibre.json", brief, 60},
    {"studies/accuracy/cut.json", brief, 60},
    {"studies/accuracy/collapse.json", brief, 60},
    {cube_file, brief, 20},
    // Mesh size.
    {beam_file, own, 60, 1},
    {beam_file, own, 150, 2},
    {cube_file, own, 60, 1},
    {cube_file, own, 200, 2},
    // Stiffness and compressibility.
    {beam_file, brief, 20, 0, 1e4, 0.3},
    {beam_file, brief, 20, 0, 1e4, 0.45},
    {beam_file, brief, 40, 0, 1e4, 0.499},
    {beam_file, brief, 20, 0, 1e5, 0.3},
    {beam_file, brief, 40, 0, 1e5, 0.499},
    {beam_file, brief, 20, 0, 1e6, 0.3},
    {beam_file, brief, 40, 0, 1e6, 0.499},
    {beam_file, brief, 40, 0, 1e7, 0.3},
    {beam_file, brief, 40, 0, 1e7, 0.45},
    {beam_file, brief, 90, 0, 1e7, 0.499},
};

/// Sets the moduli of a beam and scales its duration to as many oscillations as before, at least 0.1 s.
void make_stiffness(Scene& scene, double young, double poisson) {
  Material& material = scene.materials.front().material;
  const double before = 9 * material.parameters[1] * 2 * material.parameters[0] /
                        (3 * material.parameters[1] + 2 * material.parameters[0]);
  material.parameters = {young / (4 * (1 + poisson)), young / (3 * (1 - 2 * poisson))};
  scene.solver.duration = std::max(0.1, scene.solver.duration * std::sqrt(before / young));
  scene.name += fmt::format(" {:g} kPa poisson {}", young / 1000, poisson);
  scene.title = fmt::format("A beam let go, {:g} kPa, Poisson's ratio {}", young / 1000, poisson);
}

void make_law(Scene& scene, std::string_view law) {
  scene.materials.front().material = bench_material(law);
  scene.mesh.box->size *= 0.3;  // smaller, as the material is softer
  scene.mesh.box->cells = {4, 4, 4};
  scene.name += fmt::format(" {}", law);
  scene.title = fmt::format("A small cube of {}", law);
}

AccuracyScene scene_of(const Entry& entry) {
  Scene scene = read_scene(assets_folder() / entry.file);
  if (entry.young > 0) make_stiffness(scene, entry.young, entry.poisson);
  if (!entry.law.empty()) make_law(scene, entry.law);
  Problem problem = problem_of(scene);
  for (int k = 0; k < entry.halvings; ++k) problem = finer(problem);
  if (entry.halvings > 0) {
    const std::size_t tets = problem.setup.mesh.tets.size();
    problem.scene.name += fmt::format(" {}", tets);
    problem.scene.title += fmt::format(", {} tetrahedra", tets);
  }
  return {problem.scene.name, std::move(problem), entry.options, entry.weight};
}

}  // namespace

std::vector<AccuracyScene> accuracy_scenes(bool quick) {
  std::vector<AccuracyScene> scenes;
  for (const Entry& entry : quick ? std::span<const Entry>(quick_entries) : full_entries)
    scenes.push_back(scene_of(entry));
  if (quick) return scenes;
  std::set<std::string_view> missing;
  for (const LawInfo& law : laws()) missing.insert(law.name);
  for (const AccuracyScene& scene : scenes)
    for (const RegionMaterial& entry : scene.problem.scene.materials) missing.erase(entry.material.law);
  for (const LawInfo& law : laws())
    if (missing.contains(law.name)) scenes.push_back(scene_of({cube_file, own, 5, 0, 0, 0, law.name}));
  return scenes;
}

}  // namespace heml
