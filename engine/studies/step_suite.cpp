// Whole steps of a hanging cube: explicit and implicit, Saint Venant-Kirchhoff from 320 to a million
// tetrahedra, the factor of static solves, quadratic elements, and mesh edits.
#include <fmt/format.h>

#include <deque>
#include <heml/world/world.hpp>
#include <studies/bench.hpp>
#include <studies/bench_bodies.hpp>
#include <studies/edit_timing.hpp>
#include <studies/element_timing.hpp>
#include <studies/factor_timing.hpp>
#include <studies/interleaved_timing.hpp>
#include <studies/naive.hpp>

namespace heml {
namespace {

struct Case {
  Material material;
  Integrator integrator;
  int budget;  ///< iterations per step; 0: to the tolerance
  bool single;
  int threads;
};

/// E = 10 kPa.
Material soft(const char* law, double poisson) {
  const LameParameters lame = lame_parameters(1e4, poisson);
  Material material;
  material.law = law;
  material.parameters = {lame.lambda, lame.mu};
  return material;
}

/// Explicit methods, and implicit ones at two Poisson's ratios.
std::vector<Case> method_cases() {
  std::vector<Case> list;
  for (const int threads : bench_threads()) {
    for (const Integrator method : explicit_integrators())
      for (const bool single : {false, true}) list.push_back({soft("neo_hookean", 0.45), method, 0, single, threads});
    for (const double poisson : {0.3, 0.45})
      for (const int budget : {1, 0})
        list.push_back({soft("neo_hookean", poisson), Integrator::backward_euler, budget, false, threads});
  }
  return list;
}

/// Explicit steps of the fastest law.
std::vector<Case> size_cases() {
  std::vector<Case> list;
  for (const int threads : bench_threads())
    for (const bool single : {false, true}) list.push_back({soft("stvk", 0.3), Integrator::verlet, 0, single, threads});
  return list;
}

WorldSetup setup_of(const TetMesh& mesh, const Case& which) {
  WorldSetup setup = hanging_cube(mesh, which.material);
  setup.solver.integrator = which.integrator;
  setup.solver.single_precision = which.single;
  setup.solver.threads = which.threads;
  if (!is_explicit(which.integrator)) setup.solver.step = 1.0 / 60;
  if (which.budget > 0) setup.solver.budget = Budget{which.budget, 0};
  return setup;
}

BenchRow row_of(const BenchBody& body, const Case& which) {
  BenchRow row;
  row.mesh = body.name;
  row.nodes = body.mesh.nodes.size();
  row.tets = body.mesh.tets.size();
  row.law = which.material.law;
  row.precision = which.single ? "float" : "double";
  row.isa = name_of(instruction_sets().back());
  row.threads = which.threads;
  row.unit = "ms";
  return row;
}

double poisson_of(const Material& material) {
  const double lambda = material.parameters[0], mu = material.parameters[1];
  return lambda / (2 * (lambda + mu));
}

/// Times a step against one evaluation of the naive loop, interleaved.
BenchRow measure(const BenchBody& body, const Case& which, bool quick) {
  const WorldSetup setup = setup_of(body.mesh, which);
  const auto world = make_world(setup);
  const NaiveForces naive(body.mesh, which.material);
  std::vector<double> f(body.x.size());
  for (int k = 0; k < 3; ++k) world->tick();  // warm-up: masses, factorisations, first step bound
  const long steps_before = world->steps(), ticks_before = world->ticks(),
             work_before = world->solver_stats().iterations;
  TimingLimits limits;
  limits.seconds = quick ? 0.3 : 3;
  limits.min_rounds = quick ? 3 : 5;
  limits.min_sample = 0;  // a sample is a tick
  const auto times = time_interleaved({[&] { world->tick(); }, [&] { naive(body.x.data(), f.data()); }}, limits);
  const Timing& tick = times[0];
  const double ticks = static_cast<double>(world->ticks() - ticks_before);
  const double steps = static_cast<double>(world->steps() - steps_before), a_tick = steps / ticks;
  BenchRow row = row_of(body, which);
  row.name = integrator_name(which.integrator);
  if (which.budget > 0) row.name += fmt::format(", {} iteration", which.budget);
  row.name += fmt::format(", ν {:.2g}", poisson_of(which.material));
  row.median = 1e3 * tick.median / a_tick;
  row.min = 1e3 * tick.min / a_tick;
  row.more = {{"spread", tick.spread},
              {"samples", tick.samples},
              {"step_seconds", setup.solver.tick() / a_tick},
              {"ns_per_tet", 1e6 * row.min / static_cast<double>(row.tets)},
              {"seconds_per_simulated_second", tick.median / setup.solver.tick()},
              {"naive_evaluations", tick.min / a_tick / times[1].min}};
  row.remark = fmt::format("{:.2g} s a simulated second", tick.median / setup.solver.tick());
  if (is_explicit(which.integrator)) {
    row.ratio_to_naive = times[1].min * a_tick / tick.min;
    row.remark += fmt::format("; {:.2f} ns a tetrahedron", row.more["ns_per_tet"].get<double>());
    row.more["note"] = "naive/ours: one evaluation of the naive loop over one whole step, bound of the step included";
  } else {
    const double iterations = static_cast<double>(world->solver_stats().iterations - work_before) / steps;
    row.more["iterations_per_step"] = iterations;
    row.remark += fmt::format("; {:.1f} iterations; {:.2g} naive force evaluations", iterations,
                              row.more["naive_evaluations"].get<double>());
  }
  if (world->halt()) row.more["halted"] = row.remark = world->halt()->message;
  return row;
}

}  // namespace

std::vector<BenchRow> step_suite(const BenchOptions& options) {
  std::vector<std::function<void(std::vector<BenchRow>&)>> works;
  const auto add = [&](const BenchBody& body, const std::vector<Case>& list) {
    for (const Case& which : list)
      works.push_back([&options, &body, which](auto& rows) { rows.push_back(measure(body, which, options.quick)); });
  };
  std::deque<BenchBody> bodies;  // referenced by works
  for (const int n : options.quick ? std::vector<int>{9} : std::vector<int>{9, 13, 18})
    add(bodies.emplace_back(bench_cube(n, false)), method_cases());
  for (const int n : options.quick ? std::vector<int>{27} : std::vector<int>{4, 13, 27, 58})
    for (const bool irregular : {false, true}) add(bodies.emplace_back(bench_cube(n, irregular)), size_cases());
  for (const int n : options.quick ? std::vector<int>{9} : std::vector<int>{6, 12, 20})
    works.push_back([&options, &body = bodies.emplace_back(bench_cube(n, false))](auto& rows) {
      for (BenchRow& row : factor_rows(body, options.quick)) rows.push_back(std::move(row));
    });
  for (const int n : options.quick ? std::vector<int>{6} : std::vector<int>{6, 13})
    works.push_back([&options, n](auto& rows) {
      for (BenchRow& row : element_rows(n, options.quick)) rows.push_back(std::move(row));
    });
  for (const int n : {13, 27})
    works.push_back([&options, n](auto& rows) {
      for (BenchRow& row : edit_rows(n, options.quick)) rows.push_back(std::move(row));
    });
  std::vector<BenchRow> rows;
  for (std::size_t k = 0; k < works.size(); ++k) {
    options.progress("step", static_cast<double>(k) / static_cast<double>(works.size()));
    works[k](rows);
  }
  return rows;
}

}  // namespace heml
