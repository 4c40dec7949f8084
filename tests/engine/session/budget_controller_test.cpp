#include <doctest/doctest.h>

#include <heml/session/budget_controller.hpp>
#include <heml/session/step_cost_estimator.hpp>

namespace heml::budget_controller_test {

namespace {

/// Runs ticks of two stages, each using its whole budget, at `seconds_per_iteration` seconds per iteration. Returns the
/// budget.
int settle(BudgetController& controller, SolverStats& work, double seconds_per_iteration, int ticks) {
  for (int k = 0; k < ticks; ++k) {
    work.iterations += 2 * work.budget;
    if (const auto now = controller.after(2 * work.budget * seconds_per_iteration, work)) work.budget = *now;
  }
  return work.budget;
}

}  // namespace

TEST_CASE("a budget in milliseconds settles on the iterations that fit, and follows the machine") {
  BudgetController controller(10);
  SolverStats work;
  work.budget = 12;
  CHECK(settle(controller, work, 1e-3, 5) == 4);       // 4 × 2 × 1 ms fill 9 of 10 ms best
  CHECK(settle(controller, work, 0.4e-3, 200) == 11);  // raised one by one when iterations get cheaper
  CHECK(settle(controller, work, 1, 50) == 1);         // at least one
}

TEST_CASE("a budget is raised after ten ticks in a row with room for more, not after ticks it just fits") {
  BudgetController controller(10);
  SolverStats work;
  work.budget = 4;
  CHECK(settle(controller, work, 0.905e-3, 9) == 4);  // 4.97 iterations fit
  CHECK(settle(controller, work, 0.8e-3, 1) == 4);    // 5.03 fit on the average
  CHECK(settle(controller, work, 0.8e-3, 8) == 4);
  CHECK(settle(controller, work, 0.8e-3, 1) == 5);
}

TEST_CASE("the measured cost of a step is reported once if it is far from the estimate") {
  StepCostEstimator estimator(1000);
  const auto told = [&](double nanoseconds, int ticks) {
    int times = 0;
    double last = 0;
    for (int k = 0; k < ticks; ++k)
      if (const auto now = estimator.after((k % 3 == 0 ? 1 : 5) * 1e-9 * nanoseconds * 4 * 1000, 4))
        ++times, last = *now;
    return std::pair(times, last);
  };
  CHECK(told(35, 1000).first == 0);
  const auto [times, nanoseconds] = told(10, 1000);
  CHECK(times == 1);
  CHECK(nanoseconds == doctest::Approx(10));
}

TEST_CASE("ticks without iterations do not change the estimate") {
  BudgetController controller(10);
  SolverStats work;
  work.budget = 3;
  CHECK(!controller.after(1, work));
}

}  // namespace heml::budget_controller_test
