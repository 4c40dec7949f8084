#pragma once
// How a nonlinear solve may be done: what a scene can choose beside its integrator. The defaults are right for nearly
// every scene; studies compare the others.

#include <heml/elastic/projection.hpp>

namespace heml {

/// How Φ is made least.
enum class Minimiser {
  newton,  ///< exact stiffness first (newton.hpp)
  lbfgs    ///< the prefactored matrix and what the last steps have shown (lbfgs.hpp)
};

/// What linear solves are preconditioned with.
enum class Preconditioner {
  cholesky,     ///< of the assembled stiffness, anew each time: small bodies, and equilibrium to the last digit
  scalar,       ///< of aM + Laplacian, once: bodies in motion
  multilevel,   ///< of the same, by coarser and coarser copies of it: large bodies
  block_jacobi  ///< 3×3 diagonal blocks: bodies whose mesh changes every step
};

// The names scene files use, in the order of the enums.
inline constexpr std::string_view minimiser_names[] = {"newton", "lbfgs"};
inline constexpr std::string_view preconditioner_names[] = {"cholesky", "scalar", "multilevel", "block_jacobi"};

}  // namespace heml
