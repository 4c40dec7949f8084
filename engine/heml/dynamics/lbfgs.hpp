#pragma once
// Limited-memory BFGS (Nocedal 1980) on a prefactored matrix. An iteration costs one residual and one back-solve,
// without stiffness products. This pays where the prefactored matrix is close to the stiffness: ν up to 0.4, moderate
// strain, mild contrast of stiffness. Stopping criterion, line search and result are those of newton.hpp.
#include <heml/dynamics/newton.hpp>

namespace heml {

/// Moves the free nodes of x towards ∇Φ = 0. linear: its preconditioner must be `scalar` or `multilevel`.
NewtonResult minimise_lbfgs(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                            int max_iterations, Vector& x);

}  // namespace heml
