#pragma once
// Keeps simulated time against wall time and the account of it. Knows no thread: given the time of day, it says what is
// due.
#include <chrono>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml {

class Pacer {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;

  /// tick: seconds.
  explicit Pacer(double tick);

  /// Starts counting from now: at the start and after a pause.
  void restart(Time now);
  /// When the next tick is due to start.
  Time due() const { return at(done_); }
  /// Books one tick that ran from `began` to `ended`. When the engine is more than `patience` behind, what is owed is
  /// forgotten: simulated time slows, and no burst follows.
  void book(Time began, Time ended);
  Pace pace(Time now) const;

 private:
  static constexpr double patience = 0.05;  ///< s
  static constexpr double window = 1.0;     ///< s of wall time the slowdown is measured over

  Time at(long tick) const;

  double tick_;
  Time base_{};
  long done_ = 0;  ///< ticks since base_
  long missed_ = 0;
  struct Mark {
    Time wall;
    long ticks;
  };
  std::vector<Mark> marks_;  ///< a ring of one mark every 1/16 window: ticks done so far by the wall clock
  std::size_t next_mark_ = 0;
  long total_ = 0;
  std::vector<float> durations_;  ///< s, a ring of the last 1000
  std::size_t next_duration_ = 0;
};

}  // namespace heml
