#pragma once
// Options of a nonlinear solve that a scene can choose in addition to its integrator. The defaults suit nearly every
// scene; studies compare the others.

#include <heml/elastic/projection.hpp>

namespace heml {

/// Method that minimises Φ.
enum class Minimiser {
  newton,  ///< exact stiffness first (newton.hpp)
  lbfgs    ///< L-BFGS on the prefactored scalar matrix (lbfgs.hpp)
};

/// Preconditioner of the linear solves.
enum class Preconditioner {
  cholesky,     ///< factor of the assembled stiffness, per iteration: small bodies, static solves
  scalar,       ///< factor of the scalar matrix, rarely updated: bodies in motion
  multilevel,   ///< smoothed aggregation of the scalar matrix: large bodies
  block_jacobi  ///< 3×3 diagonal blocks of the stiffness: bodies whose mesh changes every step
};

// The names scene files use, in the order of the enums.
inline constexpr std::string_view minimiser_names[] = {"newton", "lbfgs"};
inline constexpr std::string_view preconditioner_names[] = {"cholesky", "scalar", "multilevel", "block_jacobi"};

}  // namespace heml
