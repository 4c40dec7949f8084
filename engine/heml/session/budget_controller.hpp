#pragma once
// Converts a budget in milliseconds into one in iterations, from measured tick times. The world gets the result as a
// recorded command (SetBudget), so a replay needs no clock.
#include <heml/world/solver_stats.hpp>
#include <optional>

namespace heml {

class BudgetController {
 public:
  /// milliseconds: wall time allowed per tick.
  explicit BudgetController(double milliseconds) : target_(milliseconds / 1000) {}

  /// Call after each tick. seconds: wall time of the tick. Returns the new limit of iterations per stage if it changes.
  std::optional<int> after(double seconds, const SolverStats& work);

 private:
  double target_;                     ///< s
  double seconds_per_iteration_ = 0;  ///< s of a tick per iteration, smoothed
  long iterations_before_ = 0;
  int patience_ = 0;
};

}  // namespace heml
