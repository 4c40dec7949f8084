#include <doctest/doctest.h>

#include <heml/session/budget_controller.hpp>
#include <heml/session/step_cost_estimator.hpp>

namespace heml::budget_keeper_test {

namespace {

/// Runs ticks of two stages, each using its whole budget, at `an_iteration` seconds per iteration. Returns the budget.
int settle(BudgetController& keeper, SolverStats& work, double an_iteration, int ticks) {
  for (int k = 0; k < ticks; ++k) {
    work.iterations += 2 * work.budget;
    if (const auto now = keeper.after(2 * work.budget * an_iteration, work)) work.budget = *now;
  }
  return work.budget;
}

}  // namespace

TEST_CASE("a budget in milliseconds settles on the iterations that fit, and follows the machine") {
  BudgetController keeper(10);
  SolverStats work;
  work.budget = 12;
  CHECK(settle(keeper, work, 1e-3, 5) == 4);       // 4 × 2 × 1 ms fill 9 of 10 ms best
  CHECK(settle(keeper, work, 0.4e-3, 200) == 11);  // raised one by one when iterations get cheaper
  CHECK(settle(keeper, work, 1, 50) == 1);         // at least one
}

TEST_CASE("the cost of a step is told once when it is far from what was thought, by the quietest tick") {
  StepCostEstimator keeper(1000);
  const auto told = [&](double nanoseconds, int ticks) {
    int times = 0;
    double last = 0;
    for (int k = 0; k < ticks; ++k)
      if (const auto now = keeper.after((k % 3 == 0 ? 1 : 5) * 1e-9 * nanoseconds * 4 * 1000, 4)) ++times, last = *now;
    return std::pair(times, last);
  };
  CHECK(told(35, 1000).first == 0);
  const auto [times, nanoseconds] = told(10, 1000);
  CHECK(times == 1);
  CHECK(nanoseconds == doctest::Approx(10));
}

TEST_CASE("where nothing was iterated there is nothing to learn") {
  BudgetController keeper(10);
  SolverStats work;
  work.budget = 3;
  CHECK(!keeper.after(1, work));
}

}  // namespace heml::budget_keeper_test
