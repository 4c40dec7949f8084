#pragma once
// Tells a world that chooses its method what an explicit step costs on this machine: measured here, a recorded command
// there, so that a replay chooses alike.
#include <cstddef>
#include <optional>

namespace heml {

class StepCostEstimator {
 public:
  explicit StepCostEstimator(std::size_t elements) : elements_(static_cast<double>(elements)) {}

  /// After each tick of an explicit method. seconds: it took; steps: it was cut into. Returns nanoseconds an element,
  /// where they are far from what was said last: once in a while, if ever.
  std::optional<double> after(double seconds, int steps);

 private:
  double elements_;
  double said_ = 40;  ///< ns an element: what worlds begin with
  double least_ = 0;  ///< ns an element, of the ticks since then: what else the machine did is not the step's cost
  int ticks_ = 0;
};

}  // namespace heml
