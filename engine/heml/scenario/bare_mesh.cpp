#include <algorithm>
#include <cmath>
#include <heml/scenario/bare_mesh.hpp>
#include <heml/world/facts.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

constexpr double young_moduli[] = {1e4, 2e4, 5e4, 1e5, 2e5, 5e5, 1e6, 2e6, 5e6, 1e7};
constexpr double trial_rate = 2;  // Hz
constexpr double lean = 0.05;     // of gravity, sideways: a body that would buckle does
constexpr int trial_ticks = 12, trial_iterations = 3, trial_linear = 60;  // one iteration is not enough for a column
constexpr double at_rest_below = 1e-7;  // kinetic over elastic energy: it moves by some 1e-4 of its size a tick

double largest_stretch(World& world) {
  std::vector<int> nodes(world.setup().mesh.nodes.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  std::vector<float> stretches;
  world.write_field(Field::stretch, nodes, stretches);
  double largest = 1;
  for (const float stretch : stretches) {
    if (!std::isfinite(stretch)) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, static_cast<double>(stretch));
  }
  return largest;
}

bool is_at_rest(World& world) {
  const Energies energies = world.energies();
  return world.ticks() > 3 && energies.kinetic <= at_rest_below * energies.elastic;
}

}  // namespace

std::span<const double> tissue_moduli() { return young_moduli; }

TrialRun try_tissue(const WorldSetup& setup) {
  WorldSetup trial = setup;
  SolverSettings& solver = trial.solver;
  solver.integrator = Integrator::backward_euler;
  solver.step.reset();
  solver.rate = trial_rate;
  solver.recovery = false;
  solver.budget = Budget{trial_iterations, 0, trial_linear};
  trial.gravity += lean * trial.gravity.norm() * Vec3(0.8, 0, 0.6);
  const auto world = make_world(std::move(trial));
  const double at_rest = world->stable_step();
  for (int k = 0; k < trial_ticks && !world->halt() && !is_at_rest(*world); ++k) world->tick();
  world->apply(SetDamping{setup.solver.damping});  // evaluates the stable step of the loaded body
  TrialRun run;
  run.stretch = world->halt() ? std::numeric_limits<double>::infinity() : largest_stretch(*world);
  const double step_cost = world->facts().method.step_cost;
  run.cost.seconds = step_cost * static_cast<double>(setup.mesh.tets.size());
  run.cost.stable = std::min(at_rest, world->stable_step());
  return run;
}

}  // namespace heml
