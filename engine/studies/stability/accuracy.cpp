// Cases that compare a motion with a finer one, with its equilibrium, or with its own energy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

/// The world at the end of its scene, run with steps of a given length.
std::unique_ptr<World> run(const Trial& trial, WorldSetup setup, Integrator integrator, double step) {
  setup.solver.integrator = integrator;
  setup.solver.step = step;
  auto world = trial.world(std::move(setup));
  run_until(*world, world->setup().solver.duration);
  return world;
}

/// |order − 2| of convergence over two halvings of the step, the larger of positions and velocities.
Outcome distance_from_second_order(const Trial& trial, const WorldSetup& setup, double first_step, double finest) {
  const Integrator integrator = *trial.variant.integrator;
  const auto exact = run(trial, setup, Integrator::verlet, finest);
  if (exact->halt()) return stopped(*exact);
  std::vector<double> x_error, v_error;
  for (const double step : {first_step, first_step / 2, first_step / 4}) {
    const auto world = run(trial, setup, integrator, step);
    if (world->halt()) return stopped(*world);
    x_error.push_back(rms_difference(world->positions(), exact->positions()));
    v_error.push_back(rms_difference(world->velocities(), exact->velocities()));
  }
  const double x = std::log2(x_error[1] / x_error[2]), v = std::log2(v_error[1] / v_error[2]);
  return {std::max(std::abs(x - 2), std::abs(v - 2)), 0, 0, {}, {}, fmt::format("order {:.2f} and {:.2f}", x, v)};
}

/// Rms distance from the equilibrium of the same scene, relative to that equilibrium's distance from rest.
Outcome distance_from_equilibrium(const WorldSetup& setup, World& world) {
  WorldSetup rest = setup;
  rest.solver.integrator = Integrator::static_equilibrium;
  rest.solver.single_precision = false;
  rest.solver.tolerance = 1e-8;
  const auto equilibrium = make_world(rest);  // the reference has no fault
  equilibrium->load_to(1);
  if (equilibrium->halt()) return stopped(*equilibrium);
  const double sag = rms_difference(equilibrium->positions(), rest.mesh.nodes);
  return ended(world, rms_difference(world.positions(), equilibrium->positions()) / sag);
}

/// Holds the far end of a beam along x too, a fifth of its length away, and starts from the equilibrium there: where
/// fibres slacken their stiffness jumps, and no method has its order. Nor has one while the beam still trembles, too
/// fast for the step, from the load's start, so it is damped.
void pull_taut(WorldSetup& setup) {
  setup.solver.damping = 300;
  Boundary far_end;
  far_end.translate = Vec3(0.2 * 0.1, 0, 0);
  for (std::size_t n = 0; n < setup.mesh.nodes.size(); ++n)
    if (setup.mesh.nodes[n].x() > 0.1 - 1e-9) far_end.nodes.push_back(static_cast<int>(n));
  setup.boundary.push_back(far_end);
  WorldSetup rest = setup;
  rest.loads.clear();
  rest.solver.integrator = Integrator::static_equilibrium;
  rest.solver.step.reset();
  const auto equilibrium = make_world(rest);
  equilibrium->load_to(1);
  setup.initial_positions = equilibrium->positions();
}

}  // namespace

Outcome order_of_verlet(const Trial& trial) {
  return distance_from_second_order(trial, trial.setup("07_order_of_verlet"), 4e-4, 1e-5);
}

Outcome order_of_tr_bdf2(const Trial& trial) {
  WorldSetup setup = trial.setup("08_order_of_tr_bdf2");
  setup.solver.tolerance = 1e-9;
  if (find_law(trial.variant.law)->has_fibre) pull_taut(setup);
  return distance_from_second_order(trial, setup, 0.01, 5e-5);
}

Outcome energy_drift(const Trial& trial) {
  const auto world = trial.world(trial.setup("10_energy_drift"));
  // Energy oscillates with the step but must not drift: compare means over the first and the last tenth of a second.
  double swing = 0;
  const auto mean_energy = [&](double until) {
    double sum = 0;
    int count = 0;
    for (; world->time() < until - 1e-9 && !world->halt(); ++count) {
      world->tick();
      const Energies energies = synchronous_energies(*world);
      sum += total(energies);
      swing = std::max(swing, std::abs(energies.potential));
    }
    return sum / std::max(1, count);
  };
  const double first = mean_energy(0.1);
  mean_energy(1.0);
  const double last = mean_energy(1.1);
  if (world->halt()) return stopped(*world);
  return ended(*world, std::abs(last - first) / swing);
}

Outcome stiff_and_settled(const Trial& trial) {
  const WorldSetup setup = trial.setup("20_stiff_settles");
  const auto world = trial.world(setup);
  if (!run_until(*world, setup.solver.duration)) return stopped(*world);
  return distance_from_equilibrium(setup, *world);
}

Outcome density_ratio(const Trial& trial) {
  constexpr double implicit_step = 2.5e-4;  // s, that resolves how the stiffest fibres swing
  WorldSetup setup = trial.setup("23_heavy_half");
  setup.solver.step.reset();
  if (!is_explicit(*trial.variant.integrator)) setup.solver.step = implicit_step;
  WorldSetup other = setup;  // explicit for implicit and vice versa
  other.solver.integrator = is_explicit(*trial.variant.integrator) ? Integrator::tr_bdf2 : Integrator::verlet;
  other.solver.single_precision = false;
  other.solver.step.reset();
  if (is_explicit(*trial.variant.integrator)) other.solver.step = implicit_step;
  const auto a = trial.world(setup), b = trial.world(other);
  if (!run_until(*b, setup.solver.duration)) return stopped(*b);
  if (!run_until(*a, setup.solver.duration)) return stopped(*a);
  const double moved = rms_difference(b->positions(), setup.mesh.nodes);
  return ended(*a, rms_difference(a->positions(), b->positions()) / moved);
}

Outcome jittered_steps(const Trial& trial) {
  const WorldSetup setup = trial.setup("27_jittered_steps");
  const auto world = trial.world(setup);
  const double tick = setup.solver.tick();
  double shortest = tick, longest = 0;
  for (std::uint64_t k = 0; !world->halt() && world->time() < setup.solver.duration - 1e-9; ++k) {
    const double part = 0.001 + 0.5 * (noise(27, k) + 1) * (tick - 0.002);  // then the remainder of the tick
    world->advance_within_tick(world->time() + part);
    world->tick();
    shortest = std::min({shortest, part, tick - part});
    longest = std::max({longest, part, tick - part});
  }
  if (world->halt()) return stopped(*world);
  Outcome outcome = distance_from_equilibrium(setup, *world);
  outcome.note = fmt::format("steps of {:.1f} to {:.1f} ms", 1e3 * shortest, 1e3 * longest);
  return outcome;
}

}  // namespace heml::stability
