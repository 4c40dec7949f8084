#pragma once
// Newton's method, exact first: the stiffness as it is; made positive only where its factor does not exist, its
// curvature is negative, or its direction leads nowhere (projection that is always on costs far more iterations in
// twist and bending). Of the two remedies for a factor of mixed signs, positive elements serve far from the end and
// near incompressibility, |D| past a buckling load: each is kept while it makes progress. Steps are cut by Armijo's
// rule on Φ with slack for round-off, where the slope along the step decides instead (Hager & Zhang 2005, "approximate
// Wolfe"); where forces have no potential, by that slope or by ‖r‖. States where Φ is not defined are stepped back from
// like any other bad one, and so are long steps through states that no body can pass: behind them lie minima of laws
// that bear elements inside out.
#include <functional>
#include <heml/dynamics/linear_solver.hpp>
#include <heml/dynamics/objective.hpp>

namespace heml {

/// When a solve is done: measure(r) <= limit.
struct StoppingCriterion {
  std::function<double(const Vector& r)> measure;
  double limit;
};

struct NewtonOptions {
  int max_iterations = 60;
  double linear_tolerance = 1e-2;  ///< of the first solve, ‖residual‖/‖r‖; later ones are tightened as Newton converges
  double min_linear_tolerance = min_float_tolerance;  ///< to this at most: what is left costs the next iteration less
};

struct NewtonResult {
  enum class Status { converged, out_of_iterations, stalled, undefined };
  Status status = Status::undefined;  ///< undefined: Φ is not defined at the start
  int iterations = 0;
  int projected = 0;          ///< of them with a stiffness made positive
  double measure = 0;         ///< at the end
  bool at_round_off = false;  ///< stalled there: values no longer tell steps apart, and the measure falls no further
  bool converged() const { return status == Status::converged; }
};

/// Moves x (its free nodes) towards ∇Φ = 0. Φ never rises by more than its round-off. After `stalled` no step improves
/// anything, which at round-off is as good as it gets: the caller judges by `measure`.
NewtonResult minimise(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                      const NewtonOptions& options, Vector& x);

}  // namespace heml
