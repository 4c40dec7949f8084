#pragma once
// Steps of the implicit methods: each is one or two stages (dynamics/implicit_stage.hpp), each stage one minimisation.
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/dynamics/preconditioner_build.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
class ImplicitStepper {
 public:
  explicit ImplicitStepper(Simulation<Real>& s) : s_(s) {}

  /// Steps until state.time reaches `until`, s. A step of a second-order method fails that does not converge, or ends
  /// with more energy than it began with and its loads gave it. A given step is then taken by backward Euler, which
  /// damps, also where it would invert elements; without one, the tick is halved, unless the tick before had to be
  /// rescued. Returns why no step converged; the state is then the last converged one.
  std::optional<StopReason> advance(double until);

  /// One step of backward Euler to `until`, s, to the best iterate, converged or not: Φ has not risen, and energy is
  /// limited to that of the start with the loads and supports of the end. Returns the element whose law is undefined
  /// where no step is defined; the state is then the last one, as after an interrupt, which is no failure.
  std::optional<StopReason> take_best_iterate(double until);

  /// Iterations that a stage may take under a budget (setup.solver.budget must be given).
  int stage_iterations() const;

  /// World::preconditioner_build().
  std::shared_ptr<PreconditionerBuild> preconditioner_build();
  /// Adopts the build given out last if it is done and of the current elements; else builds it here, to the same bits.
  void adopt_preconditioner();

 private:
  class StagedStep;
  bool step(Integrator method, double h, double time_after);
  bool lagging_step(double h, double time_after);
  bool damped_step(double h, double time_after);
  bool is_noisy(double h, double time_after);
  bool takes_any_iterate() const { return s_.setup->solver.budget || takes_best_; }
  bool solve_stage(const Stage& stage, double h, double time, Vector& x, Vector& v);
  NewtonResult minimise_stage(double least_limit, Vector& x);
  int probe_substeps(double h) const;
  StoppingCriterion stage_criterion();
  bool is_balanced_enough(const Stage& stage, const Vector& r);
  std::string why_unbalanced() const;

  Simulation<Real>& s_;
  Vector residual_;                 ///< 3 #V, N, of the stage solved last
  bool takes_best_ = false;         ///< a stage ends with its best iterate, as under a budget
  std::vector<Real> undefined_at_;  ///< 3 #V, start of the last stage whose forces were undefined; empty: defined
  std::shared_ptr<PreconditionerBuild> preconditioner_build_;  ///< given out last
  long preconditioner_version_ = 0;                            ///< topology version it is of
};

}  // namespace heml
