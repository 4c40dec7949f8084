#pragma once
// Measures the cost of an explicit step on this machine, for worlds that choose the integrator. The world gets it as a
// recorded command (SetStepCost), so that a replay chooses alike.
#include <cstddef>
#include <optional>

namespace heml {

class StepCostEstimator {
 public:
  explicit StepCostEstimator(std::size_t elements) : elements_(static_cast<double>(elements)) {}

  /// Call after each tick of an explicit method. seconds: wall time of the tick; steps: substeps in it. Returns the
  /// cost per element and substep (ns) when it differs from the last one returned by more than a factor 1.5.
  std::optional<double> after(double seconds, int steps);

 private:
  double elements_;
  double said_ = 40;  ///< ns per element, last returned; initially the worlds' default
  double least_ = 0;  ///< ns per element, minimum since the last check, which excludes other load of the machine
  int ticks_ = 0;
};

}  // namespace heml
