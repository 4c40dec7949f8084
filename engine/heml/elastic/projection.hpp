#pragma once
// Stiffness made positive: what Newton's method takes where the exact one leads nowhere, never before it is seen to.
#include <string_view>

namespace heml {

enum class Projection {
  none,  ///< the stiffness itself: |D| of its factor L D Lᵀ, or what conjugate gradients find before it turns negative
  shift,    ///< itself with as much on the diagonal as it takes
  element,  ///< negative eigenvalues of every element's stiffness to 0
  tension   ///< HEML's own: negative eigenvalues of the stress that its tensions are made of to 0, and of the rest
};

/// The names scene files use, in the order of the enum.
inline constexpr std::string_view projection_names[] = {"none", "shift", "element", "tension"};

}  // namespace heml
