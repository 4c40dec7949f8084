#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <heml/base/hash.hpp>
#include <heml/mesh/subdivide.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/world/finer_setup.hpp>
#include <studies/problem.hpp>

namespace heml {
namespace {

constexpr double rate = 1000;  // Hz, ticks of explicit methods without a given step

std::vector<double> lumped_masses(const WorldSetup& setup) {
  const auto entry = material_of_elements(setup.mesh, setup.materials);
  std::vector<double> mass(setup.mesh.nodes.size(), 0);
  for (std::size_t t = 0; t < setup.mesh.tets.size(); ++t) {
    const Tet& tet = setup.mesh.tets[t];
    const auto at = [&](std::size_t a) { return setup.mesh.nodes[static_cast<std::size_t>(tet[a])]; };
    const double density = setup.materials[static_cast<std::size_t>(entry[t])].material.density;
    for (const int node : tet)
      mass[static_cast<std::size_t>(node)] += density * signed_volume(at(0), at(1), at(2), at(3)) / 4;
  }
  return mass;
}

/// Resolves grasps given by a point to the nearest nodes of this mesh: finer meshes have other nodes nearer.
void resolve_grasps(Problem& problem) {
  for (const auto& [index, points] : problem.scene.points)
    set_nodes(problem.scene.events.at(index).command, problem.setup.mesh, points);
  problem.scene.points.clear();
}

/// Replaces elements that events remove by number with their eight parts.
void subdivide_removals(std::vector<Event>& events) {
  for (Event& event : events)
    if (auto* remove = std::get_if<RemoveElements>(&event.command)) {
      std::vector<int> parts;
      for (const int tet : remove->which.tets)
        for (int part = 0; part < 8; ++part) parts.push_back(8 * tet + part);
      remove->which.tets = parts;
    }
}

bool has_separate_volume_term(const Material& material, VolumeTerm volume_term) {
  return find_law(material.law)->has_volume_term && material.volume_term == volume_term;
}

}  // namespace

Problem problem_of(const Scene& scene) {
  Problem problem{scene, load_setup(scene), {}};
  if (problem.scene.name.empty()) problem.scene.name = std::filesystem::path(scene.file).stem().string();
  resolve_grasps(problem);
  return with_masses(std::move(problem));
}

Problem with_masses(Problem problem) {
  problem.mass = lumped_masses(problem.setup);
  return problem;
}

Problem finer(const Problem& problem) {
  Problem result = problem;
  Subdivision cut = subdivide_uniformly(problem.setup.mesh);
  result.setup = on_finer_mesh(std::move(result.setup), std::move(cut.mesh), cut.midpoint_edges);
  subdivide_removals(result.scene.events);
  return with_masses(std::move(result));
}

Problem with_element(Problem problem, bool nodal_pressure) {
  problem.scene.solver.nodal_pressure = problem.setup.solver.nodal_pressure = nodal_pressure;
  return problem;
}

bool supports_nodal_pressure(const Problem& problem) {
  const auto& materials = problem.setup.materials;
  const VolumeTerm term = materials.front().material.volume_term;
  const bool at_start = std::all_of(materials.begin(), materials.end(), [&](const RegionMaterial& m) {
    return has_separate_volume_term(m.material, term);
  });
  const auto& events = problem.scene.events;
  return at_start && std::all_of(events.begin(), events.end(), [&](const Event& event) {
           const auto* change = std::get_if<SetMaterial>(&event.command);
           return !change || has_separate_volume_term(change->material, term);
         });
}

std::vector<bool> elements_of(const Problem& problem) {
  if (!supports_nodal_pressure(problem)) return {problem.nodal_pressure()};
  return {problem.nodal_pressure(), !problem.nodal_pressure()};
}

std::string key_of(const Problem& problem) {
  std::uint64_t hash = mesh_fingerprint(problem.setup.mesh).hash;
  for (const char c : scene_text(problem.scene)) hash = hash_combine(hash, static_cast<std::uint64_t>(c));
  for (const Vec3& x : problem.setup.initial_positions)
    for (const double coordinate : x) hash = hash_combine(hash, std::bit_cast<std::uint64_t>(coordinate));
  return fmt::format("{} {:016x}", problem.scene.name, hash);
}

std::string text_of(const Problem& problem) {
  return fmt::format("{}, {} tetrahedra", problem.nodal_pressure() ? "nodal_pressure" : "p1",
                     problem.setup.mesh.tets.size());
}

Scene with_method(Scene scene, const Method& method) {
  const double tick_before = scene.solver.tick();
  SolverSettings& solver = scene.solver;
  solver.integrator = method.integrator;
  solver.step = method.step;
  if (!method.step) solver.rate = rate;
  solver.budget.reset();
  if (method.iterations > 0) solver.budget = Budget{method.iterations, 0};
  solver.single_precision = method.single_precision;
  solver.threads = method.threads;
  for (Event& event : scene.events)
    event.tick = std::lround(static_cast<double>(event.tick) * tick_before / solver.tick());
  scene.checkpoints.clear();
  scene.recorded_ticks.reset();
  scene.recorded_end.reset();
  scene.recorded_mesh.reset();
  return scene;
}

std::string text_of(const Method& method) {
  std::string text = fmt::format("{}, {}", integrator_name(method.integrator),
                                 method.step ? fmt::format("steps of {:.3g} ms", 1e3 * *method.step) : "live steps");
  if (method.iterations > 0)
    text += fmt::format(", {} iteration{}", method.iterations, method.iterations == 1 ? "" : "s");
  else if (!is_explicit(method.integrator))
    text += ", to tolerance";
  if (method.single_precision) text += ", float";
  if (method.threads == 0) text += ", all cores";
  return text;
}

}  // namespace heml
