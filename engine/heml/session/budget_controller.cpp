#include <algorithm>
#include <heml/session/budget_controller.hpp>

namespace heml {
namespace {
constexpr double used_share = 0.9;  // of the budget that is used
constexpr double smoothing = 0.1;   // weight of the last tick
constexpr int max_iterations = 60;
constexpr int ticks_to_raise = 10;  // lowered at once, raised after this many ticks in a row with room for more
}  // namespace

std::optional<int> BudgetController::after(double seconds, const SolverStats& work) {
  const long done = work.iterations - iterations_before_;
  iterations_before_ = work.iterations;
  if (done <= 0 || work.budget <= 0) return std::nullopt;
  const double now = seconds / static_cast<double>(done);
  seconds_per_iteration_ =
      seconds_per_iteration_ > 0 ? seconds_per_iteration_ + smoothing * (now - seconds_per_iteration_) : now;
  // Estimated stages per tick, for any method.
  const double stages = std::max(1.0, static_cast<double>(done) / work.budget);
  const int best =
      static_cast<int>(std::clamp(used_share * target_ / (stages * seconds_per_iteration_), 1.0, 1.0 * max_iterations));
  const bool has_room = best > work.budget;
  if (has_room && ++patience_ < ticks_to_raise) return std::nullopt;
  patience_ = 0;
  if (best == work.budget) return std::nullopt;
  return has_room ? work.budget + 1 : best;
}

}  // namespace heml
