#pragma once
// Schedules ticks against wall time and keeps statistics of it. Independent of threads and clocks: all times are passed
// in.
#include <chrono>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// tick: s, period.
  explicit Pacer(double tick);

  /// Starts counting from now: at the start and after a pause.
  void restart(Time now);
  /// Ticks have another period from now on.
  void set_tick(double tick, Time now);
  /// When the next tick should start.
  Time due() const { return at(done_); }
  /// Records a tick that ran from `began` to `ended`. When it is more than `patience` late, the schedule restarts from
  /// `ended`: simulated time slows, and no burst follows.
  void book(Time began, Time ended);
  Pace pace(Time now) const;

 private:
  static constexpr double patience = 0.05;  ///< s
  static constexpr double window = 1.0;     ///< s of wall time over which the slowdown is measured

  Time at(long tick) const;

  double tick_;
  Time base_{};
  long done_ = 0;  ///< ticks since base_
  long missed_ = 0;
  struct Mark {
    Time wall;
    long ticks;
  };
  std::vector<Mark> marks_;  ///< ring buffer of wall time and total ticks, every 1/16 of `window`
  std::size_t next_mark_ = 0;
  long total_ = 0;
  std::vector<float> durations_;  ///< s, ring buffer of the last 1000 ticks
  std::size_t next_duration_ = 0;
};

}  // namespace heml
