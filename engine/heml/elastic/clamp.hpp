#pragma once
// Projection of an element's stiffness to positive semidefinite (projection.hpp).
#include <heml/elastic/edge_stiffness.hpp>

namespace heml {

/// Sets negative eigenvalues of an element's stiffness to 0; leaves a K that is not finite.
template <class Real>
void clamp_element(Real K[edge_entries]);

/// Tension projection: splits K into T̂_ab I, with T̂ = V L Ŝ Lᵀ (A = LLᵀ) the tensions of the whole stress, volume
/// term included, and a rest, and sets negative eigenvalues of Ŝ and of the rest to 0. Near J = 0 the volume term has
/// no such form, and clamp_element() is used. t: the tensions at which K was evaluated.
template <class Real>
void clamp_tension(const Tensions<Real>& t, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                   Real K[edge_entries]);

}  // namespace heml
