#pragma once
// Advances a world through a scene: tick by tick, with the scene's events, and to times between ticks.
#include <functional>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/world/world.hpp>

namespace heml {

class Player {
 public:
  /// world: of the scene, before its first tick; must outlive the player. Throws InputError as Schedule does.
  Player(const Scene& scene, World& world);

  /// Advances to a time (s; static scene: fraction of the load) not before the last one, or until the world halts. A
  /// time within a tick is reached by shortened steps. on_tick: called after every tick; returns false to stop. Throws
  /// InputError when the world refuses an event.
  void to(
      double time, const std::function<bool()>& on_tick = [] { return true; });

  /// s since the start. World::time() is that of the state, which a reset or an undo takes back.
  double time() const { return world_.time() + taken_back_; }

  std::span<const Event> past_events() const { return schedule_.past(); }  ///< applied to the world so far

 private:
  struct End {
    long tick;    ///< whole ticks before a time
    double rest;  ///< s after them
  };
  End end_at(double time) const;
  bool is_reached(const End& end) const;
  void begin_tick();

  World& world_;
  Schedule schedule_;
  double tick_;            ///< s
  double rate_start_ = 0;  ///< s, simulated, since when ticks have this length
  long rate_tick_ = 0;     ///< the tick then
  double tick_start_ = 0;  ///< s, World::time() at the start of the tick
  double taken_back_ = 0;  ///< s, of World::time() by events
  long begun_ = -1;
};

}  // namespace heml
