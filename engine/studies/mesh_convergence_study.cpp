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

constexpr double min_order = 0.5, max_order = 4, proven_order = 2;

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

}  // namespace

Extrapolation extrapolate(const std::vector<std::vector<Vec3>>& x, const std::vector<Vec3>& rest,
                          const std::vector<double>& mass, std::vector<Vec3>& best) {
  Extrapolation result;
  if (x.size() < 3) {
    result.failure = "fewer than three meshes";
    return result;
  }
  const auto &u0 = x[x.size() - 3], &u1 = x[x.size() - 2], &u2 = x[x.size() - 1];
  result.order = std::log2(rms_distance(u0, u1, mass) / rms_distance(u1, u2, mass));
  if (!(result.order >= min_order && result.order <= max_order)) {
    result.failure = fmt::format("three meshes converge with order {:.2g}: too irregular to go on from", result.order);
    return result;
  }
  const auto as_shown = extrapolated(u1, u2, result.order), as_proven = extrapolated(u1, u2, proven_order);
  result.uncertainty = rms_distance(as_shown, as_proven, mass) / 2;
  best = as_shown;
  for (std::size_t n = 0; n < best.size(); ++n) best[n] = (as_shown[n] + as_proven[n]) / 2;
  result.motion = rms_distance(best, rest, mass);
  const std::size_t far = farthest(best, rest);
  result.far = best[far] - rest[far];
  return result;
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
  if (!(fall > 0) || !(order >= min_order && order <= max_order)) return std::nullopt;
  const double as_shown = last[0] - fall / (ratio - 1), as_proven = last[0] - fall / (std::pow(2, proven_order) - 1);
  return Potential{(as_shown + as_proven) / 2, std::abs(as_shown - as_proven) / 2};
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
  for (const std::string& element : elements_of(problem))
    steps += static_cast<std::size_t>(halvings_for(element, halvings) + 1);
  return steps;
}

MeshConvergenceStudy study_mesh_convergence(const std::string& key, const Problem& problem, int halvings,
                                            const StudyContext& context) {
  MeshConvergenceStudy study;
  const Problem first = *linear_base(problem);
  const auto& rest = first.setup.mesh.nodes;
  std::vector<std::vector<Vec3>> all, best_of_element;
  for (const std::string& element : elements_of(problem)) {
    Problem base = first;
    std::vector<std::vector<Vec3>> settled;
    std::vector<double> potentials;
    const std::size_t first_mesh = study.meshes.size();
    for (int k = 0; k <= halvings_for(element, halvings); ++k) {
      if (k > 0) base = finer(base);
      const Problem now = with_element(base, element);
      const Json found = context.kept(fmt::format("{}|settled|{}", key, text_of(now)),
                                      [&] { return solve_statics(now, rest.size(), context.make); });
      ConvergenceMesh& mesh = study.meshes.emplace_back();
      mesh.element = element, mesh.halvings = k;
      mesh.nodes = found["nodes"], mesh.tets = found["tets"], mesh.seconds = found["seconds"];
      mesh.failed = found["failed"];
      all.push_back(positions_from(found["x"]));
      if (!mesh.failed.empty()) continue;
      settled.push_back(all.back());
      mesh.moved = rms_distance(all.back(), rest, first.mass);
      mesh.stored = found["stored"];
      if (found.contains("estimated")) mesh.estimated = found["estimated"];
      if (found.contains("potential")) potentials.push_back(mesh.potential = found["potential"]);
    }
    if (const auto limit = element == "p1" ? extrapolate(potentials) : std::nullopt)
      for (std::size_t k = first_mesh; k < study.meshes.size(); ++k) {
        ConvergenceMesh& mesh = study.meshes[k];
        if (const double above = mesh.potential - limit->best; mesh.failed.empty() && above > 2 * limit->uncertainty)
          mesh.known = 2 * above;
      }
    std::vector<Vec3> best;
    Extrapolation of_element = extrapolate(settled, rest, first.mass, best);
    of_element.element = element;
    const bool is_first = study.reference.element.empty(), succeeds = of_element.failure.empty();
    if (is_first ||
        (succeeds && (!study.reference.failure.empty() || of_element.uncertainty < study.reference.uncertainty))) {
      study.reference = of_element;
      study.best = best;
    }
    if (succeeds) best_of_element.push_back(best);
  }
  if (best_of_element.size() > 1) {
    double largest = 0;
    for (const auto& best : best_of_element) largest = std::max(largest, rms_distance(best, study.best, first.mass));
    study.reference.between_elements = largest;
  }
  if (!study.reference.failure.empty()) {
    study.best.clear();
    return study;
  }
  for (std::size_t k = 0; k < study.meshes.size(); ++k) {
    ConvergenceMesh& mesh = study.meshes[k];
    if (!mesh.failed.empty()) continue;
    const double error = rms_distance(all[k], study.best, first.mass);
    mesh.resolved = error >= study.reference.resolution();
    mesh.error = std::max(error, study.reference.resolution());
    mesh.relative = mesh.error / study.reference.motion;
    const std::size_t far = farthest(study.best, rest);
    mesh.far = all[k][far] - rest[far];
  }
  return study;
}

}  // namespace heml
