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
  const double ticks = time / tick_, nearest = std::round(ticks);
  const bool at_tick = std::abs(ticks - nearest) < same_tick;
  const long whole = static_cast<long>(at_tick ? nearest : std::floor(ticks));
  while (world_.ticks() < whole && !world_.halt()) {
    begin_tick();
    world_.tick();
    if (!on_tick()) return;
  }
  if (at_tick || world_.halt()) return;
  begin_tick();
  world_.advance_within_tick(tick_start_ + (time - static_cast<double>(whole) * tick_));
}

/// Applies the events of the next tick, once. They may include a reset, which sets the world's time to 0.
void Player::begin_tick() {
  if (begun_ == world_.ticks()) return;
  begun_ = world_.ticks();
  schedule_.apply(world_);
  tick_start_ = world_.time();
}

}  // namespace heml
