#pragma once
// Ends a tick whose implicit steps did not converge, in scenes that give no step:
//
//   halved steps (implicit_stepper.hpp) ──► not converged at 1/64 of the tick
//                    │ where the scene asks for recovery and the body is in bad shape, that begins instead
//                    ▼
//   Verlet substeps to the end of the tick, contact by impulses
//                    │ more than max_explicit_substeps, one of them fails, or they gain more energy than can be taken
//                    │ from the velocities: all of them are undone
//                    ▼
//   one step of backward Euler, whose best iterate is taken: Φ has not risen, and energy is limited
//                    │ the law is undefined there, because supports leave no room: the world halts
//
// A failure costs many iterations, and what causes it rarely ends within a tick. So explicit substeps go on for the
// next ticks; then the whole implicit step is tried once, without halves. Bounds count force evaluations and
// iterations; no clock is read.
#include <heml/world/explicit_stepper.hpp>
#include <heml/world/implicit_stepper.hpp>

namespace heml {

inline constexpr int max_explicit_substeps = 2000;  ///< of a rescued tick, one force evaluation each
inline constexpr long ticks_of_rescue = 8;          ///< from a failure to the next implicit step that is tried

template <class Real>
class StepRescue {
 public:
  StepRescue(Simulation<Real>& s, ExplicitStepper<Real>& explicit_steps, ImplicitStepper<Real>& implicit_steps)
      : s_(s), explicit_(explicit_steps), implicit_(implicit_steps) {}

  /// Whether explicit substeps, in the ticks after a failure, have ended this tick at `until`, s, as well. Else nothing
  /// has changed, and implicit steps are to be tried.
  bool goes_on(double until);
  /// From where implicit steps failed to `until`, s. Returns `failure` where a step is given, which is obeyed, and the
  /// element out of its law's range where no step is defined; the state is then the last valid one.
  std::optional<StopReason> end_tick(double until, const StopReason& failure);

 private:
  struct Start;
  bool take_explicit_substeps(double until);
  bool limit_gain(double before, double until);
  std::optional<double> energy(double time);
  Start save();
  void restore(const Start& start);

  Simulation<Real>& s_;
  ExplicitStepper<Real>& explicit_;
  ImplicitStepper<Real>& implicit_;
};

}  // namespace heml
