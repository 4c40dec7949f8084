#include <algorithm>
#include <heml/mesh/generate.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/law_study.hpp>
#include <studies/naive.hpp>

namespace heml {
namespace {

constexpr double size = 0.03;  // m: sinks by a few per cent
constexpr double tolerance = 1e-10;

Problem cube_of(const Material& material) {
  Problem problem;
  WorldSetup& setup = problem.setup;
  setup.mesh = make_box(Vec3(size, size, size), {3, 3, 3});
  setup.materials = {{std::nullopt, material}};
  Boundary bottom, top;
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n) {
    if (setup.mesh.nodes[n].y() < 1e-9) bottom.nodes.push_back(static_cast<int>(n));
    if (setup.mesh.nodes[n].y() > size - 1e-9) top.nodes.push_back(static_cast<int>(n));
  }
  top.axis = Vec3(0, 1, 0);
  top.origin = Vec3(size / 2, 0, size / 2);
  top.degrees = 10;
  top.translate = Vec3(0.1 * size, 0, 0);
  setup.boundary = {bottom, top};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = Integrator::static_equilibrium;
  setup.solver.tolerance = tolerance;
  setup.solver.threads = 1;
  return with_masses(std::move(problem));
}

/// Largest residual of naive forces and weight at a free node, relative to the largest nodal weight.
double left_over(const Problem& problem, const std::vector<Vec3>& positions) {
  const WorldSetup& setup = problem.setup;
  const NaiveForces naive(setup.mesh, setup.materials.front().material);
  std::vector<double> x, f(3 * positions.size());
  for (const Vec3& at : positions) x.insert(x.end(), {at.x(), at.y(), at.z()});
  naive(x.data(), f.data());
  std::vector<bool> constrained(positions.size(), false);
  for (const Boundary& boundary : setup.boundary)
    for (const int node : boundary.nodes) constrained[static_cast<std::size_t>(node)] = true;
  double left = 0, weight = 0;
  for (std::size_t n = 0; n < positions.size(); ++n) {
    if (constrained[n]) continue;
    const Vec3 own = problem.mass[n] * setup.gravity;
    left = std::max(left, (Vec3(f[3 * n], f[3 * n + 1], f[3 * n + 2]) + own).norm());
    weight = std::max(weight, own.norm());
  }
  return left / weight;
}

Json solve_statics(const Material& material, const MakeWorld& make) {
  const Problem problem = cube_of(material);
  const auto world = make(problem.setup);
  world->load_to(1);
  return {{"failed", world->halt() ? world->halt()->message : ""},
          {"left_over", left_over(problem, world->positions())}};
}

}  // namespace

std::size_t steps_of_law_study() { return bench_materials().size(); }

std::vector<LawCheck> study_laws(const StudyContext& context) {
  std::vector<LawCheck> laws;
  for (const Material& material : bench_materials()) {
    const Json found =
        context.kept("law at rest|" + material.law, [&] { return solve_statics(material, context.make); });
    laws.push_back(
        {material.law, found["failed"], found["left_over"].is_null() ? 0 : found["left_over"].get<double>()});
  }
  return laws;
}

}  // namespace heml
