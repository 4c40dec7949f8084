// Cases that start with a collapsed or inverted body, which must return to rest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <studies/stability/measures.hpp>

namespace heml::stability {
namespace {

constexpr double at_rest = 1e-3;  // rms over the diagonal
constexpr int max_steps = 60;

/// Steps until the body has been at rest for six steps, at most max_steps; measures its distance from rest.
Outcome steps_to_rest(World& world) {
  int since = 0;
  for (int step = 1; step <= max_steps && !world.halt(); ++step) {
    world.tick();
    const bool good = away_from_rest(world) <= at_rest && inverted(world) == 0;
    if (!good) since = 0;
    if (good && since == 0) since = step;
    if (since > 0 && step >= since + 5) break;
  }
  if (world.halt()) return stopped(world);
  return ended(world, away_from_rest(world), since > 0 ? fmt::format("{} steps", since) : "not within 60 steps");
}

/// Backward Euler dissipates energy and comes to rest by itself; other methods get damping and 1.5 s.
Outcome back_to_rest(const Trial& trial, const std::string& scene, double poisson) {
  WorldSetup setup = trial.setup(scene);
  const bool damps = setup.solver.integrator == Integrator::backward_euler;
  set_young_poisson(setup, 1e4, poisson);
  if (!damps) setup.solver.damping = 30;
  if (is_explicit(setup.solver.integrator)) {
    setup.solver.step.reset();
    setup.solver.rate = 1000;
  }
  const auto world = trial.world(setup);
  if (world->halt()) return stopped(*world);
  if (damps) return steps_to_rest(*world);
  if (!run_until(*world, 1.5)) return stopped(*world);
  return ended(*world, away_from_rest(*world));
}

/// The worst outcome over scenes and Poisson's ratios; the note names the slowest.
Outcome from_all(const Trial& trial, std::span<const char* const> scenes) {
  Outcome outcome;
  std::string slowest;
  for (const char* scene : scenes)
    for (const double poisson : {0.3, 0.49, 0.499}) {
      if (trial.quick && poisson == 0.49) continue;
      const Outcome one = back_to_rest(trial, scene, poisson);
      if (!(one.value <= outcome.value) || !one.stopped.empty())
        slowest = fmt::format("{}, ν {}{}{}", scene, poisson, one.note.empty() ? "" : ": ", one.note);
      outcome = worse(outcome, one);
    }
  outcome.note = slowest;
  return outcome;
}

}  // namespace

Outcome collapsed(const Trial& trial) {
  constexpr const char* scenes[] = {"13_point", "13_line", "13_plane", "13_scatter"};
  return from_all(trial, scenes);
}

Outcome mirrored(const Trial& trial) {
  constexpr const char* scenes[] = {"15_mirrored"};
  return from_all(trial, scenes);
}

Outcome yanked(const Trial& trial) {
  const Scene scene = read_scene(assets_folder() / "scenes" / "extreme" / "26_yanked.json");
  const auto world = trial.world(trial.setup("26_yanked"));
  Schedule schedule(scene, world->setup().mesh);
  double farthest = 0;
  while (!world->halt() && world->time() < scene.solver.duration - 1e-9) {
    schedule.apply(*world);
    world->tick();
    if (find_tool<GraspState>(world->tools())) farthest = std::max(farthest, away_from_rest(*world));
  }
  if (world->halt()) return stopped(*world);
  Outcome outcome = ended(*world, away_from_rest(*world), fmt::format("bent by {:.2f} of its size", farthest));
  if (!(farthest > 0.02)) outcome.broken = "the tool did not pull it";
  return outcome;
}

}  // namespace heml::stability
