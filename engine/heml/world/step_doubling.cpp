#include <algorithm>
#include <cmath>
#include <heml/world/step_doubling.hpp>
#include <utility>

namespace heml {
namespace {

/// With steps that are given, for advance_within_tick() to end.
WorldSetup as_shadow(WorldSetup setup) {
  setup.solver.step = setup.solver.tick();
  setup.solver.threads = 1;
  setup.solver.recovery = false;
  return setup;
}

}  // namespace

StepDoublingEstimator::StepDoublingEstimator(WorldSetup setup) : world_(make_world(as_shadow(std::move(setup)))) {}

bool StepDoublingEstimator::begin(const World& leader) {
  ticks_.clear(), moves_.clear();
  if (leader.setup().solver.is_static() || !world_->copy_motion_from(leader)) return false;
  integrator_ = *find_integrator(leader.solver_stats().integrator);
  begin_ = leader.time();
  recoveries_ = leader.recoveries();
  lost_ = false;
  return true;
}

void StepDoublingEstimator::ticked(const World& leader) {
  ticks_.push_back({leader.time(), leader.substeps(), std::exchange(moves_, {})});
  lost_ |= leader.halt() || leader.recoveries() != recoveries_ ||
           find_integrator(leader.solver_stats().integrator) != integrator_;
}

std::optional<TimeError> StepDoublingEstimator::error(const std::vector<Vec3>& reached) {
  if (lost_ || ticks_.empty()) return std::nullopt;
  if (world_->setup().solver.integrator != integrator_) world_->apply(SetIntegrator{integrator_});
  double time = begin_;
  for (const Tick& tick : ticks_) {
    for (const MoveTool& move : tick.moves) world_->apply(move);
    const int steps = 2 * std::max(tick.steps, 1);
    for (int k = 1; k <= steps; ++k)
      world_->advance_within_tick(k == steps ? tick.end : time + (tick.end - time) * k / steps);
    if (world_->halt()) return std::nullopt;
    time = tick.end;
  }
  const double richardson = info_of(integrator_).order == 1 ? 2 : 4.0 / 3;
  const std::vector<Vec3> x = world_->positions();
  TimeError error{0, 0, time - begin_};
  for (std::size_t n = 0; n < x.size(); ++n) {
    const double apart = richardson * (x[n] - reached[n]).norm();
    error.rms += apart * apart / static_cast<double>(x.size());
    error.max = std::max(error.max, apart);
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

}  // namespace heml
