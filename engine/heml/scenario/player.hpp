#pragma once
// Takes a world through a scene's motion: tick by tick, with the events, and to times between ticks.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/world/world.hpp>

namespace heml {

class Player {
 public:
  /// world: of the scene, before its first tick; must live as long as the player. Throws InputError as Schedule does.
  Player(const Scene& scene, World& world);

  /// On to a time, s, that is not before the last one (of a static scene: to a fraction of the load), or to where the
  /// world halts. A time within a tick is reached by shortened steps. on_tick: after every tick; false ends it there.
  /// Throws InputError when the world refuses an event.
  void to(
      double time, const std::function<bool()>& on_tick = [] { return true; });

  std::span<const Event> past_events() const { return schedule_.past(); }  ///< handed to the world so far

 private:
  void begin_tick();

  World& world_;
  Schedule schedule_;
  double tick_;            ///< s
  double tick_start_ = 0;  ///< s, by the world's clock
  long begun_ = -1;
};

}  // namespace heml
