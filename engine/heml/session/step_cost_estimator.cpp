#include <algorithm>
#include <heml/session/step_cost_estimator.hpp>

namespace heml {
namespace {
constexpr int ticks_to_be_sure = 200;
constexpr double reported_ratio = 1.5;  // ratio of old and new cost that is reported
}  // namespace

std::optional<double> StepCostEstimator::after(double seconds, int steps) {
  if (steps <= 0) return std::nullopt;
  const double now = 1e9 * seconds / (static_cast<double>(steps) * elements_);
  least_ = ticks_++ == 0 ? now : std::min(least_, now);
  if (ticks_ < ticks_to_be_sure) return std::nullopt;
  ticks_ = 0;
  if (least_ < reported_ratio * said_ && said_ < reported_ratio * least_) return std::nullopt;
  return said_ = least_;
}

}  // namespace heml
