#pragma once
// Projections of the stiffness to positive definite, for Newton iterations in which the exact stiffness fails
// (newton.hpp).
#include <string_view>

namespace heml {

enum class Projection {
  none,     ///< exact stiffness: |D| of its factor L D Lᵀ, or the CG iterate before negative curvature
  shift,    ///< a sufficient multiple of the identity added
  element,  ///< negative eigenvalues of every element's stiffness set to 0
  tension   ///< HEML's own: negative eigenvalues of the stress of the tensions, and of the rest, set to 0
};

/// The names scene files use, in the order of the enum.
inline constexpr std::string_view projection_names[] = {"none", "shift", "element", "tension"};

}  // namespace heml
