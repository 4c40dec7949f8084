#pragma once
// Recovery of a body that was inverted, became unstable or collapsed:
//
//   after a tick ──► check: min J, inverted elements, speeds ──► nothing wrong: the state is kept as the last good one,
//                    │                                              with what the materials remember
//                    │ something is wrong, or a step failed
//                    ▼
//   the last good state, or the current one where there never was any; its nodes perturbed by 1e-5 of the body's size
//                    ▼
//   a stable Neo-Hookean surrogate (recovery_surrogate.hpp) steps by backward Euler, one step a tick, strongly damped,
//   each step ending no higher than it began in Φ = a/2 ‖x − y‖²_M + U
//                    │ min J > 0.3 for some steps, the body calm, and the scene's law defined
//                    ▼
//   back to the scene's law and method; positions and velocities are kept
//
// Positions are continuous from step to step: constrained nodes follow their motion, grasps keep their hold.
#include <heml/world/method_choice.hpp>
#include <heml/world/recovery_cause.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class RecoveryController {
 public:
  RecoveryController(Simulation<Real>& s, MethodChoice<Real>& method) : s_(s), method_(method) {}

  /// Starts monitoring at the current state if the scene asks for recovery.
  void start();
  /// Checks the state after a tick; begins a recovery if it is bad. Returns why recovery cannot help.
  std::optional<StopReason> monitor();
  /// Begins a recovery from a failed step. Returns false where it would fail again on a body in good shape.
  bool takes_over(const StopReason& failure);
  /// One step of the surrogate, and the return to the scene's law when the body has recovered.
  void step(double until);
  /// Follows changed elements, masses, materials or constraints, between ticks: rebuilds the surrogate if there is one,
  /// else keeps the state anew.
  void follow_change();

 private:
  double max_wave_speed() const;
  double shear_wave_speed() const;
  bool is_step_hopeless() const;
  void keep_state();
  void go_back();
  void begin(const StateCheck& check);
  FailureDiagnosis diagnose(const StateCheck& check) const;
  double burn_shrink_at(int element) const;
  bool is_loaded() const;
  void perturb();
  void step_surrogate(double until);
  void move_towards_rest(double part);
  void end();

  Simulation<Real>& s_;
  MethodChoice<Real>& method_;
};

}  // namespace heml
