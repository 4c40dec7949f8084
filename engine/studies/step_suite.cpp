#include <fmt/format.h>

#include <heml/studies/bench.hpp>
#include <heml/studies/bench_bodies.hpp>
#include <heml/studies/naive.hpp>
#include <heml/studies/rounds.hpp>
#include <heml/world/world.hpp>

namespace heml {
namespace {

struct Case {
  Integrator integrator;
  double poisson;
  int budget;  ///< iterations a step; 0: to the tolerance
  bool single;
  int threads;
};

std::vector<Case> cases() {
  std::vector<Case> list;
  for (const int threads : bench_threads()) {
    for (const Integrator method : {Integrator::symplectic_euler, Integrator::verlet})
      for (const bool single : {false, true}) list.push_back({method, 0.45, 0, single, threads});
    for (const double poisson : {0.3, 0.45})
      for (const int budget : {1, 0}) list.push_back({Integrator::backward_euler, poisson, budget, false, threads});
  }
  return list;
}

/// A cube of very soft tissue that hangs from one face, and swings.
WorldSetup setup_of(const TetMesh& mesh, const Case& which) {
  const Lame lame = lame_from(1e4, which.poisson);
  Material material;
  material.law = "neo_hookean";
  material.parameters = {lame.lambda, lame.mu};
  WorldSetup setup;
  setup.mesh = mesh;
  setup.materials = {{std::nullopt, material}};
  Boundary held;
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n)
    if (mesh.nodes[n].x() < 1e-9) held.nodes.push_back(static_cast<int>(n));
  setup.boundary = {held};
  setup.gravity = Vec3(0, -9.81, 0);
  setup.solver.integrator = which.integrator;
  setup.solver.single_precision = which.single;
  setup.solver.threads = which.threads;
  if (!is_explicit(which.integrator)) setup.solver.step = 1.0 / 60;
  if (which.budget > 0) setup.solver.budget = Budget{which.budget, 0};
  return setup;
}

BenchRow measure(const TetMesh& mesh, const std::string& name, const Case& which, bool quick) {
  const WorldSetup setup = setup_of(mesh, which);
  const auto world = make_world(setup);
  const BenchBody body = bench_body(name, mesh);
  const NaiveForces naive(body.mesh, setup.materials.front().material);
  std::vector<double> f(body.x.size());
  for (int k = 0; k < 3; ++k) world->tick();  // masses, factors, the first estimate of the limit
  const long steps_before = world->steps(), ticks_before = world->ticks(),
             work_before = world->solver_work().iterations;
  RoundLimits limits;
  limits.seconds = quick ? 0.3 : 3;
  limits.fewest = quick ? 3 : 5;
  limits.shortest_sample = 0;  // a sample is a tick
  const auto times = time_in_turn({[&] { world->tick(); }, [&] { naive(body.x.data(), f.data()); }}, limits);
  const Timing& tick = times[0];
  const double ticks = static_cast<double>(world->ticks() - ticks_before);
  const double steps = static_cast<double>(world->steps() - steps_before), a_tick = steps / ticks;
  BenchRow row;
  row.name = integrator_name(which.integrator);
  if (which.budget > 0) row.name += fmt::format(", {} iteration", which.budget);
  row.name += fmt::format(", ν {}", which.poisson);
  row.mesh = name;
  row.nodes = mesh.nodes.size();
  row.tets = mesh.tets.size();
  row.law = "neo_hookean";
  row.precision = which.single ? "float" : "double";
  row.isa = name_of(instruction_sets().back());
  row.threads = which.threads;
  row.median = 1e3 * tick.median / a_tick;
  row.min = 1e3 * tick.min / a_tick;
  row.unit = "ms";
  row.more = {{"spread", tick.spread},
              {"samples", tick.samples},
              {"step_seconds", setup.solver.tick() / a_tick},
              {"seconds_per_simulated_second", tick.median / setup.solver.tick()},
              {"naive_evaluations", tick.min / a_tick / times[1].min}};
  row.beside = fmt::format("{:.2g} naive force evaluations; {:.2g} s a simulated second",
                           row.more["naive_evaluations"].get<double>(), tick.median / setup.solver.tick());
  if (!is_explicit(which.integrator)) {
    const double iterations = static_cast<double>(world->solver_work().iterations - work_before) / steps;
    row.more["iterations_per_step"] = iterations;
    row.beside += fmt::format("; {:.1f} iterations", iterations);
  }
  if (world->halt()) row.more["halted"] = row.beside = world->halt()->message;
  return row;
}

}  // namespace

std::vector<BenchRow> step_suite(const BenchOptions& options) {
  std::vector<BenchRow> rows;
  const std::vector<int> cubes = options.quick ? std::vector<int>{9} : std::vector<int>{9, 13, 18};
  const auto list = cases();
  double done = 0;
  for (const int n : cubes) {
    const BenchBody cube = bench_cube(n, false);
    for (const Case& which : list) {
      options.progress(fmt::format("step: {}, {}", cube.name, integrator_name(which.integrator)),
                       done++ / static_cast<double>(cubes.size() * list.size()));
      rows.push_back(measure(cube.mesh, cube.name, which, options.quick));
    }
  }
  return rows;
}

}  // namespace heml
