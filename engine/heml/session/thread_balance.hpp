#pragma once
// Chooses the number of stepping threads while the rest of the process, mainly drawing, needs cores too: a core shared
// with drawing half of the time delays every parallel loop that waits for its thread. Depends on no clock: wall and
// processor times are passed in.
//
//   free = cores − (processor time of others) / (wall time);  threads = free, rounded down, at least one
#include <optional>

namespace heml {

class ThreadBalance {
 public:
  explicit ThreadBalance(int cores) : cores_(cores), threads_(cores) {}

  /// Whether look() is due at `wall` (s, of a steady clock): every 0.5 s.
  bool is_due(double wall) const { return wall - wall_ >= interval; }
  /// Measures once. others: processor time (s) that the rest of the process has used so far. Returns the number of
  /// threads if it changes; it is raised only after two calls in a row that allow it.
  std::optional<int> look(double wall, double others);

  int threads() const { return threads_; }
  double load_of_others() const { return load_; }  ///< cores, between the last two looks

 private:
  static constexpr double interval = 0.5;  ///< s

  int cores_, threads_;
  double wall_ = -interval, others_ = -1, load_ = 0;
  int looks_with_more_ = 0;
};

}  // namespace heml
