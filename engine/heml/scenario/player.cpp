#include <cmath>
#include <heml/scenario/player.hpp>

namespace heml {
namespace {
constexpr double same_tick = 1e-6;  // of a tick: times this close to its end count as its end
}

Player::Player(const Scene& scene, World& world)
    : world_(world), schedule_(scene, world.setup().mesh), tick_(scene.solver.tick()) {}

void Player::to(double time, const std::function<bool()>& on_tick) {
  if (world_.setup().solver.is_static()) {
    begin_tick();
    return world_.load_to(time);
  }
  while (!world_.halt() && !is_reached(end_at(time))) {
    begin_tick();
    const End end = end_at(time);  // an event may have changed the rate
    if (world_.ticks() >= end.tick) return world_.advance_within_tick(tick_start_ + end.rest);
    world_.tick();
    if (!on_tick()) return;
  }
}

bool Player::is_reached(const End& end) const { return world_.ticks() >= end.tick && end.rest == 0; }

Player::End Player::end_at(double time) const {
  const double here = time - rate_start_, ticks = here / tick_, nearest = std::round(ticks);
  const bool at_tick = std::abs(ticks - nearest) < same_tick;
  const double whole = at_tick ? nearest : std::floor(ticks);
  return {rate_tick_ + static_cast<long>(whole), at_tick ? 0 : here - whole * tick_};
}

/// Applies the events of the next tick, once. They may include a reset or an undo, which take the world's time back,
/// and another rate.
void Player::begin_tick() {
  if (begun_ == world_.ticks()) return;
  begun_ = world_.ticks();
  const double before = world_.time();
  schedule_.apply(world_);
  tick_start_ = world_.time();
  if (tick_start_ != before) taken_back_ = world_.elapsed() - tick_start_;
  const double tick = world_.setup().solver.tick();
  if (tick == tick_) return;
  rate_start_ = world_.elapsed();
  rate_tick_ = world_.ticks();
  tick_ = tick;
}

}  // namespace heml
