#pragma once
// Turns a budget in milliseconds into one in iterations, by what ticks are seen to take. The clock stays here: what the
// world gets is a command, which is recorded like any other, so a replay needs no clock.
#include <heml/world/solver_stats.hpp>
#include <optional>

namespace heml {

class BudgetController {
 public:
  /// milliseconds: of a tick.
  explicit BudgetController(double milliseconds) : target_(milliseconds / 1000) {}

  /// After each tick. seconds: it took. Returns how many iterations a stage should be allowed from now on, where that
  /// is not what it is.
  std::optional<int> after(double seconds, const SolverStats& work);

 private:
  double target_;            ///< s
  double an_iteration_ = 0;  ///< s, with its share of all else; smoothed
  long iterations_before_ = 0;
  int patience_ = 0;
};

}  // namespace heml
