#pragma once
// Stiffness made positive: what Newton's method takes where the exact one leads nowhere, never before it is seen to.
#include <heml/elastic/edge_stiffness.hpp>
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

/// Negative eigenvalues of an element's stiffness to 0.
template <class Real>
void clamp_element(Real K[edge_entries]);

/// K = T̂_ab I + the rest, T̂ = V L Ŝ Lᵀ with all of the stress, the volume term's too (A = LLᵀ): both made positive.
/// Near J = 0, where the volume term has no such form, as clamp_element(). t: what K was made with.
template <class Real>
void clamp_tension(const Tensions<Real>& t, const Link<Real>& link, const RestShape<Real>& rest, Real K[edge_entries]);

}  // namespace heml
