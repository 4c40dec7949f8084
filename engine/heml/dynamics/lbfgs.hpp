#pragma once
// Limited-memory BFGS (Nocedal 1980) on a prefactored matrix: an iteration is one residual and one back-solve, no
// product, which pays where the prefactored matrix is near the stiffness: ν up to 0.4, moderate strain, mild contrast
// of stiffness. Stop, line search and result as Newton's (newton.hpp).
#include <heml/dynamics/newton.hpp>

namespace heml {

/// Moves x (its free nodes) towards ∇Φ = 0. linear: a preconditioner that is made once, `scalar` or `multilevel`.
NewtonResult minimise_lbfgs(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                            int max_iterations, Vector& x);

}  // namespace heml
