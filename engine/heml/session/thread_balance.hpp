#pragma once
// How many threads stepping gets while the rest of the process (drawing, above all) needs processors too: a core that
// is drawn on for half of the time delays every loop that waits for the thread on it. Knows no clock: it is told how
// much processor time the others have had.
//
//   free = cores − (processor time of others) / (wall time);  threads = free, rounded down, one at least
#include <optional>

namespace heml {

class ThreadBalance {
 public:
  explicit ThreadBalance(int cores) : cores_(cores), threads_(cores) {}

  /// Whether `wall` (s, of a steady clock) is time for another look, twice a second.
  bool is_due(double wall) const { return wall - wall_ >= interval; }
  /// One look. others: processor time, s, that the rest of the process has had so far. Returns the number of threads
  /// where it changes. More threads come only after two looks in a row that allow them.
  std::optional<int> look(double wall, double others);

  int threads() const { return threads_; }
  double load_of_others() const { return load_; }  ///< cores, over the last look

 private:
  static constexpr double interval = 0.5;  ///< s

  int cores_, threads_;
  double wall_ = -interval, others_ = -1, load_ = 0;
  int looks_with_more_ = 0;
};

}  // namespace heml
