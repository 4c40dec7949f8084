#pragma once
// Steps of the explicit methods (dynamics/integrator_list.hpp).
#include <heml/world/simulation.hpp>
#include <heml/world/thread_trial.hpp>
#include <limits>

namespace heml {

template <class Real>
class ExplicitStepper {
 public:
  explicit ExplicitStepper(Simulation<Real>& s) : s_(s) {}

  /// Steps until state.time reaches `until`, s, or `most` substeps are done. Returns why it could not; the state is
  /// then the last valid one.
  std::optional<StopReason> advance(double until, long most = std::numeric_limits<long>::max());

 private:
  void refresh_stable_step();
  std::optional<StopReason> step(Real h, double time_after);
  template <class Method>
  std::optional<StopReason> step_with(Real h, double time_after);
  std::string why_no_step() const;

  Simulation<Real>& s_;
  ThreadTrial trial_;
};

}  // namespace heml
