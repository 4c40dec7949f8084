#pragma once
// Newton's method with the exact stiffness first. The stiffness is projected only if its factor does not exist, its
// curvature is negative or its direction does not lower Φ; projection in every iteration costs far more iterations in
// twist and bending. There are two remedies for negative curvature: projected elements work better far from the
// solution and near incompressibility, |D| of the exact factor past a buckling load. Each is kept while it makes
// progress. line_search.hpp limits the steps; it avoids long steps that invert elements, since laws that are defined at
// J < 0 have spurious minima there.
#include <atomic>
#include <functional>
#include <heml/dynamics/linear_solver.hpp>
#include <heml/dynamics/objective.hpp>

namespace heml {

/// A solve has converged when measure(r) <= limit.
struct StoppingCriterion {
  std::function<double(const Vector& r)> measure;
  double limit;
  double round_off_limit = limit;  ///< a measure that need not fall further where values are round-off
  const std::atomic<bool>* interrupted = nullptr;  ///< once it is set, a solve ends as one out of iterations does
  bool is_interrupted() const { return interrupted && *interrupted; }
};

struct NewtonOptions {
  int max_iterations = 60;
  double linear_tolerance = 1e-2;                     ///< first ‖residual‖/‖r‖; tightened as Newton converges
  double min_linear_tolerance = min_float_tolerance;  ///< lower bound of the tightened tolerance
  bool refines = true;                                ///< asks for a more precise Φ where its values are round-off
  bool projects_first = false;  ///< where iterations are too few to try another direction at negative curvature
};

struct NewtonResult {
  enum class Status { converged, out_of_iterations, stalled, undefined };
  Status status = Status::undefined;  ///< undefined: Φ is not defined at the start
  int iterations = 0;
  int projected = 0;          ///< of these, iterations with a projected stiffness
  double measure = 0;         ///< at the end
  bool at_round_off = false;  ///< stalled because values are round-off and the measure falls no further
  bool converged() const { return status == Status::converged; }
};

/// Moves the free nodes of x towards ∇Φ = 0. Φ never rises by more than its round-off. After `stalled` no step improves
/// x; since that is the best result at round-off, the caller judges by `measure`.
NewtonResult minimise(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                      const NewtonOptions& options, Vector& x);

}  // namespace heml
