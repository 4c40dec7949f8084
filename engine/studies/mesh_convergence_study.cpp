#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <studies/accuracy_reference.hpp>
#include <studies/mesh_convergence_study.hpp>

namespace heml {
namespace {

/// A mesh of quadratic elements has as many nodes as the next one of linear ones.
int halvings_for(const std::string& element, int times) {
  return is_quadratic(element) ? std::max(times - 1, 0) : times;
}

constexpr double min_order = 0.25, min_energy_order = 0.5, max_order = 4;
constexpr double linear_order = 2, quadratic_order = 3;  // of smooth solutions

void tell_energies(const Problem& problem, World& world, Json& json) {
  const Energies energies = world.energies();
  json["stored"] = energies.elastic;
  if (problem.setup.loads.empty()) json["potential"] = energies.elastic + energies.potential;
  if (const auto estimate = world.error_estimate()) json["estimated"] = estimate->squared;
}

/// Static solve under the whole load. "x" has the positions of the first `nodes` nodes.
Json solve_statics(const Problem& problem, std::size_t nodes, const MakeWorld& make) {
  WorldSetup setup = problem.setup;
  SolverSettings& solver = setup.solver;
  solver.integrator = Integrator::static_equilibrium;
  solver.single_precision = solver.recovery = false;
  solver.tolerance.reset(), solver.budget.reset(), solver.step.reset();
  solver.threads = 0;
  const auto began = std::chrono::steady_clock::now();
  const auto world = make(std::move(setup));
  world->load_to(1);
  Json json = {{"seconds", std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count()},
               {"nodes", problem.setup.mesh.nodes.size()},
               {"tets", problem.setup.mesh.tets.size()},
               {"failed", world->halt() ? world->halt()->message : ""},
               {"x", Json::array()}};
  if (!world->halt()) tell_energies(problem, *world, json);
  const auto x = world->positions();
  if (!world->halt())
    for (std::size_t n = 0; n < nodes; ++n)
      for (int i = 0; i < 3; ++i) json["x"].push_back(x[n][i]);
  return json;
}

std::vector<Vec3> positions_from(const Json& list) {
  std::vector<Vec3> x;
  for (std::size_t k = 0; k + 2 < list.size(); k += 3) x.emplace_back(list[k], list[k + 1], list[k + 2]);
  return x;
}

std::size_t farthest(const std::vector<Vec3>& x, const std::vector<Vec3>& rest) {
  std::size_t best = 0;
  for (std::size_t n = 0; n < x.size(); ++n)
    if ((x[n] - rest[n]).norm() > (x[best] - rest[best]).norm()) best = n;
  return best;
}

std::vector<Vec3> extrapolated(const std::vector<Vec3>& coarse, const std::vector<Vec3>& fine, double order) {
  std::vector<Vec3> result(fine);
  for (std::size_t n = 0; n < fine.size(); ++n) result[n] += (fine[n] - coarse[n]) / (std::pow(2, order) - 1);
  return result;
}

/// From the last two of nested solutions, where the error falls with an order between low and high.
Extrapolation between(const std::vector<std::vector<Vec3>>& x, double low, double high, const std::vector<Vec3>& rest,
                      const std::vector<double>& mass) {
  Extrapolation result;
  result.low = low, result.high = high;
  const auto by_low = extrapolated(x[x.size() - 2], x.back(), low);
  const auto by_high = extrapolated(x[x.size() - 2], x.back(), high);
  result.uncertainty = rms_distance(by_low, by_high, mass) / 2;
  result.best = by_low;
  for (std::size_t n = 0; n < rest.size(); ++n) result.best[n] = (by_low[n] + by_high[n]) / 2;
  result.motion = rms_distance(result.best, rest, mass);
  const std::size_t far = farthest(result.best, rest);
  result.far = result.best[far] - rest[far];
  return result;
}

/// The equilibria of an element that were found, from coarse to fine.
struct Nested {
  std::string element;               ///< name
  std::vector<std::size_t> meshes;   ///< places in the study's list
  std::vector<std::vector<Vec3>> x;  ///< m, at the first mesh's nodes
  std::vector<double> potentials;    ///< J; none under loads that have none
};

ConvergenceMesh mesh_from(const Json& found, const std::string& element, int halvings) {
  ConvergenceMesh mesh;
  mesh.element = element, mesh.halvings = halvings;
  mesh.nodes = found["nodes"], mesh.tets = found["tets"], mesh.seconds = found["seconds"];
  mesh.failed = found["failed"];
  if (!mesh.failed.empty()) return mesh;
  mesh.stored = found["stored"];
  mesh.potential = found.value("potential", 0.0);
  if (found.contains("estimated")) mesh.estimated = found["estimated"];
  return mesh;
}

/// Those of the problem, and p1, from which quadratic ones are extrapolated.
std::vector<std::string> elements_studied(const Problem& problem) {
  std::vector<std::string> elements = elements_of(problem);
  if (std::find(elements.begin(), elements.end(), "p1") == elements.end()) elements.push_back("p1");
  return elements;
}

void find_energy_errors(const Nested& nested, std::vector<ConvergenceMesh>& meshes) {
  const auto limit = extrapolate(nested.potentials);
  if (!limit) return;
  for (const std::size_t k : nested.meshes)
    if (const double above = meshes[k].potential - limit->best; above > 2 * limit->uncertainty)
      meshes[k].known = 2 * above;
}

/// Of all elements the extrapolation with the smallest uncertainty.
Extrapolation best_reference(const std::vector<Nested>& solutions, const std::vector<Vec3>& rest,
                             const std::vector<double>& mass) {
  std::vector<Extrapolation> all;
  Extrapolation linear;
  linear.failure = "linear elements were not studied";
  for (const Nested& nested : solutions)
    if (nested.element == "p1") linear = extrapolate(nested.x, rest, mass);
  for (const Nested& nested : solutions) {
    all.push_back(is_quadratic(nested.element) ? extrapolate_quadratic(nested.x, linear, rest, mass)
                                               : extrapolate(nested.x, rest, mass));
    all.back().element = nested.element;
    all.back().meshes = nested.x.size();
  }
  const auto succeeds = [](const Extrapolation& e) { return e.failure.empty(); };
  Extrapolation best = all.front();
  for (const Extrapolation& one : all)
    if (succeeds(one) && (!succeeds(best) || one.uncertainty < best.uncertainty)) best = one;
  if (std::count_if(all.begin(), all.end(), succeeds) > 1) best.between_elements = 0;
  for (const Extrapolation& one : all)
    if (succeeds(one) && best.between_elements)
      best.between_elements = std::max(*best.between_elements, rms_distance(one.best, best.best, mass));
  return best;
}

/// x: the mesh's equilibrium at the first mesh's nodes.
void tell_error(ConvergenceMesh& mesh, const std::vector<Vec3>& x, const Extrapolation& reference,
                const std::vector<Vec3>& rest, const std::vector<double>& mass) {
  const double error = rms_distance(x, reference.best, mass);
  mesh.resolved = error >= reference.resolution();
  mesh.error = std::max(error, reference.resolution());
  mesh.relative = mesh.error / reference.motion;
  const std::size_t far = farthest(reference.best, rest);
  mesh.far = x[far] - rest[far];
}

}  // namespace

Extrapolation extrapolate(const std::vector<std::vector<Vec3>>& x, const std::vector<Vec3>& rest,
                          const std::vector<double>& mass) {
  Extrapolation none;
  if (x.size() < 3) {
    none.failure = "fewer than three meshes";
    return none;
  }
  const auto* last = &x.back();
  const double order = std::log2(rms_distance(last[-2], last[-1], mass) / rms_distance(last[-1], last[0], mass));
  if (order >= min_order && order <= max_order) return between(x, order, linear_order, rest, mass);
  none.failure = fmt::format("three meshes converge with order {:.2g}: too irregular to go on from", order);
  return none;
}

Extrapolation extrapolate_quadratic(const std::vector<std::vector<Vec3>>& x, const Extrapolation& linear,
                                    const std::vector<Vec3>& rest, const std::vector<double>& mass) {
  // Coarse meshes may show more than 2 by chance, from which no certainty follows.
  if (x.size() >= 2 && linear.failure.empty())
    return between(x, std::min(linear.low, linear_order), quadratic_order, rest, mass);
  Extrapolation none;
  none.failure = x.size() < 2 ? "fewer than two meshes" : linear.failure;
  return none;
}

std::optional<double> ConvergenceMesh::effectivity() const {
  if (!estimated || !known) return std::nullopt;
  return std::sqrt(*estimated / *known);
}

double ConvergenceMesh::estimated_length() const {
  return estimated ? *estimated / (2 * stored + *estimated) * moved : 0;
}

std::optional<Potential> extrapolate(const std::vector<double>& potentials) {
  if (potentials.size() < 3) return std::nullopt;
  const double *last = &potentials.back(), fall = last[-1] - last[0], ratio = (last[-2] - last[-1]) / fall;
  const double order = std::log2(ratio);  // of the squared norm: 2 asymptotically
  if (!(fall > 0) || !(order >= min_energy_order && order <= max_order)) return std::nullopt;
  const double as_shown = last[0] - fall / (ratio - 1), as_smooth = last[0] - fall / (std::pow(2, linear_order) - 1);
  return Potential{(as_shown + as_smooth) / 2, std::abs(as_shown - as_smooth) / 2};
}

const ConvergenceMesh* MeshConvergenceStudy::find(const std::string& element, int halvings) const {
  for (const ConvergenceMesh& mesh : meshes)
    if (mesh.element == element && mesh.halvings == halvings && mesh.failed.empty()) return &mesh;
  return nullptr;
}

int halvings_within(std::size_t tets, std::size_t most, int halvings) {
  int count = 0;
  while (count < halvings && 8 * tets <= most) tets *= 8, ++count;
  return count;
}

std::vector<Vec3> equilibrium_positions(const std::string& key, const Problem& problem, const StudyContext& context) {
  return positions_from(context.kept(fmt::format("{}|settled|{}", key, text_of(problem)), [&] {
    return solve_statics(problem, problem.setup.mesh.nodes.size(), context.make);
  })["x"]);
}

std::size_t steps_of_mesh_convergence_study(const Problem& problem, int halvings) {
  std::size_t steps = 0;
  for (const std::string& element : elements_studied(problem))
    steps += static_cast<std::size_t>(halvings_for(element, halvings) + 1);
  return steps;
}

MeshConvergenceStudy study_mesh_convergence(const std::string& key, const Problem& problem, int halvings,
                                            const StudyContext& context) {
  const Problem first = *linear_base(problem);
  const auto& rest = first.setup.mesh.nodes;
  MeshConvergenceStudy study;
  std::vector<Nested> solutions;
  for (const std::string& element : elements_studied(problem)) {
    Nested& nested = solutions.emplace_back(Nested{element, {}, {}, {}});
    Problem base = first;
    for (int k = 0; k <= halvings_for(element, halvings); ++k) {
      if (k > 0) base = finer(base);
      const Problem now = with_element(base, element);
      const Json found = context.kept(fmt::format("{}|settled|{}", key, text_of(now)),
                                      [&] { return solve_statics(now, rest.size(), context.make); });
      ConvergenceMesh& mesh = study.meshes.emplace_back(mesh_from(found, element, k));
      if (!mesh.failed.empty()) continue;
      nested.meshes.push_back(study.meshes.size() - 1);
      nested.x.push_back(positions_from(found["x"]));
      mesh.moved = rms_distance(nested.x.back(), rest, first.mass);
      if (found.contains("potential")) nested.potentials.push_back(mesh.potential);
    }
    if (element == "p1") find_energy_errors(nested, study.meshes);
  }
  study.reference = best_reference(solutions, rest, first.mass);
  if (study.reference.failure.empty())
    for (const Nested& nested : solutions)
      for (std::size_t k = 0; k < nested.x.size(); ++k)
        tell_error(study.meshes[nested.meshes[k]], nested.x[k], study.reference, rest, first.mass);
  return study;
}

}  // namespace heml
