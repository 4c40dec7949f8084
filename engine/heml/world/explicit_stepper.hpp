#pragma once
// Steps of the explicit methods (dynamics/integrator_list.hpp).
#include <heml/world/simulation.hpp>
#include <heml/world/step_strain.hpp>
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
  template <class Method>
  void begin_step(Real h, double time_after);
  template <class Method>
  void begin_bearable_step(Real& h, double time_after);
  void list_contacts(bool all);
  bool checks_strain() const;
  bool may_try_shorter(const StopReason& failure, double h);
  void shorten(double h);
  double most_steps(double time) const;
  std::string why_no_step() const;

  Simulation<Real>& s_;
  ThreadTrial trial_;
  StepStrain<Real> strain_;
  typename ContactImpulses<Real>::Record before_;  ///< of the step's start
  std::vector<int> touched_;                       ///< list_contacts()
};

}  // namespace heml
