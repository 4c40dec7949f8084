#pragma once
// How an element's stiffness is made positive (projection.hpp).
#include <heml/elastic/edge_stiffness.hpp>

namespace heml {

/// Negative eigenvalues of an element's stiffness to 0.
template <class Real>
void clamp_element(Real K[edge_entries]);

/// K = T̂_ab I + the rest, T̂ = V L Ŝ Lᵀ with all of the stress, the volume term's too (A = LLᵀ): both made positive.
/// Near J = 0, where the volume term has no such form, as clamp_element(). t: what K was made with.
template <class Real>
void clamp_tension(const Tensions<Real>& t, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                   Real K[edge_entries]);

}  // namespace heml
