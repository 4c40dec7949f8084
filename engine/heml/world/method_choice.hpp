#pragma once
// The method that `"integrator": "auto"` uses, at the start and from tick to tick, by a fixed model of cost and never
// by a clock, so that a scene gives the same bits on every machine: explicit where that is fast enough or the given
// step is stable; else the accurate implicit method where steps resolve the motion; else the one that damps what they
// do not. A margin keeps the choice from flickering as the stable step follows the deformation.
//
// The cost of a step may be given (SetStepCost): sessions measure it and record the result as a command.
#include <heml/world/facts.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class MethodChoice {
 public:
  explicit MethodChoice(Simulation<Real>& s) : s_(s) {}

  /// Sets s.method: the scene's integrator, or the choice of "auto".
  void choose();
  /// At the start of a tick; does nothing unless the scene says "auto".
  void reconsider();
  /// seconds: of an explicit step, per element, on one core.
  void set_step_cost(double seconds) { s_.step_cost = seconds; }
  MethodFacts facts();

 private:
  Integrator chosen();
  double explicit_load() const;
  double explicit_share() const;
  double step_cost() const;
  double lowest_frequency();

  Simulation<Real>& s_;
};

}  // namespace heml
