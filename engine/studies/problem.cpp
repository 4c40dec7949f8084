#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cassert>
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
    const double whole = density * signed_volume(at(0), at(1), at(2), at(3));
    const bool quadratic = !setup.midedges.empty();
    for (const int node : tet) mass[static_cast<std::size_t>(node)] += whole * (quadratic ? 1.0 / 36 : 1.0 / 4);
    if (quadratic)
      for (const int node : setup.midedges[t]) mass[static_cast<std::size_t>(node)] += whole * 4 / 27;
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

constexpr double high_poisson = 0.45;

/// Without what quadratic elements refuse.
bool supports_quadratic(const Problem& problem) {
  const auto is_continuum = [](const Material& material) { return find_law(material.law)->is_continuum; };
  const auto& [scene, setup, mass] = problem;
  const auto& materials = setup.materials;
  return !setup.self_contact && !setup.tearing && !scene.mesh.refine &&
         std::all_of(materials.begin(), materials.end(),
                     [&](const RegionMaterial& m) { return is_continuum(m.material); }) &&
         std::none_of(scene.events.begin(), scene.events.end(), [&](const Event& event) {
           const auto* change = std::get_if<SetMaterial>(&event.command);
           return continues_stroke(event.command).has_value() ||
                  std::holds_alternative<RemoveElements>(event.command) || (change && !is_continuum(change->material));
         });
}

bool is_nearly_incompressible(const Problem& problem) {
  const auto& materials = problem.setup.materials;
  return std::any_of(materials.begin(), materials.end(), [](const RegionMaterial& m) {
    const auto [shear, bulk] = small_strain_moduli(m.material);
    return (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear) >= high_poisson;
  });
}

void set_element(const std::string& element, SolverSettings& solver) {
  solver.quadratic = is_quadratic(element);
  solver.nodal_pressure = element.ends_with("pressure");
  if (solver.quadratic) solver.recovery = false;
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
  assert(problem.setup.midedges.empty());
  Problem result = problem;
  Subdivision cut = subdivide_uniformly(problem.setup.mesh);
  result.setup = on_finer_mesh(std::move(result.setup), std::move(cut.mesh), cut.midpoint_edges);
  subdivide_removals(result.scene.events);
  return with_masses(std::move(result));
}

bool is_quadratic(const std::string& element) { return element.starts_with("p2"); }

Problem with_element(Problem problem, const std::string& element) {
  assert(problem.setup.midedges.empty() || is_quadratic(element));
  set_element(element, problem.scene.solver);
  set_element(element, problem.setup.solver);
  if (!is_quadratic(element) || !problem.setup.midedges.empty()) return problem;
  problem.setup = with_midedges(std::move(problem.setup));
  return with_masses(std::move(problem));
}

std::optional<Problem> linear_base(const Problem& problem) {
  if (problem.setup.midedges.empty()) return problem;
  Problem base = problem;
  WorldSetup& setup = base.setup;
  const auto corners = static_cast<int>(setup.mesh.nodes.size() - count_nodes(setup.midedges));
  for (const Tet& tet : setup.mesh.tets)
    for (const int node : tet)
      if (node >= corners) return std::nullopt;
  const auto is_midedge = [&](int node) { return node >= corners; };
  setup.midedges.clear();
  setup.mesh.nodes.resize(static_cast<std::size_t>(corners));
  if (!setup.initial_positions.empty()) setup.initial_positions.resize(static_cast<std::size_t>(corners));
  for (Boundary& boundary : setup.boundary) std::erase_if(boundary.nodes, is_midedge);
  for (Load& load : setup.loads) std::erase_if(load.nodes, is_midedge);
  return with_masses(with_element(std::move(base), setup.solver.nodal_pressure ? "nodal_pressure" : "p1"));
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

std::vector<std::string> elements_of(const Problem& problem) {
  std::vector<std::string> elements{problem.element()};
  const bool splits = supports_nodal_pressure(problem);
  if (is_quadratic(elements[0])) {
    if (splits) elements.push_back(elements[0] == "p2" ? "p2_pressure" : "p2");
    return elements;
  }
  if (splits) elements.push_back(elements[0] == "p1" ? "nodal_pressure" : "p1");
  if (supports_quadratic(problem))
    elements.push_back(splits && is_nearly_incompressible(problem) ? "p2_pressure" : "p2");
  return elements;
}

std::string key_of(const Problem& problem) {
  std::uint64_t hash = mesh_fingerprint(problem.setup.mesh).hash;
  for (const char c : scene_text(problem.scene)) hash = hash_combine(hash, static_cast<std::uint64_t>(c));
  for (const Vec3& x : problem.setup.initial_positions)
    for (const double coordinate : x) hash = hash_combine(hash, std::bit_cast<std::uint64_t>(coordinate));
  return fmt::format("{} {:016x}", problem.scene.name, hash);
}

std::string text_of(const Problem& problem) {
  return fmt::format("{}, {} tetrahedra", problem.element(), problem.setup.mesh.tets.size());
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
