#pragma once
// Schedules ticks against wall time and keeps statistics of it. Independent of threads and clocks: all times are passed
// in.
#include <chrono>
#include <deque>
#include <heml/session/frame.hpp>

namespace heml {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// tick: s, period.
  explicit Pacer(double tick) : tick_(tick) {}

  /// Starts counting from now: at the start and after a pause.
  void restart(Time now);
  /// Ticks have another period from now on.
  void set_tick(double tick, Time now);
  /// When the next tick should start.
  Time due() const { return at(done_); }
  /// Records a tick that ran from `began` to `ended`. When it is more than `patience` late, the schedule restarts from
  /// `ended`: simulated time slows, and no burst follows.
  void book(Time began, Time ended);
  /// Records a tick that had no deadline, as in fast-forwarding. The schedule restarts from `ended`.
  void book_unscheduled(Time began, Time ended);
  Pace pace() const;

 private:
  static constexpr double patience = 0.05;  ///< s
  static constexpr double window = 1.0;     ///< s of wall time over which pace() looks back

  Time at(long tick) const;
  void keep(Time began, Time ended);

  double tick_;
  Time base_{};
  long done_ = 0;  ///< ticks since base_
  long missed_ = 0;
  struct Tick {
    Time ended;
    float duration;  ///< s
  };
  std::deque<Tick> ticks_;  ///< that ended within `window` of the last one; at least that one
  Time window_began_{};     ///< when the tick before ticks_ ended, or the schedule was restarted
};

}  // namespace heml
