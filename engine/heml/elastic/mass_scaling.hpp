#pragma once
// Mass scaling: the masses of the few nodes whose elements limit the steps of explicit methods, small or flat ones, are
// multiplied (conventional mass scaling in Olovsson, Simonsson & Unosson, International Journal for Numerical Methods
// in Engineering 63, 2005). Gravity acts on the true masses: equilibria stay, motion is slower where mass is added.
//
//   B_a  |     ░           B_a of a node (step_weights.hpp) is inverse to its mass, which B_a/T times as large makes it
//     T ─┼─ ─ ─█─ ─ ░─ ─   T. The step is then that of T, and no other way to add as much, Σ m_a (B_a/T − 1), makes the
//        |▁ ▃▅ █ ▂▃ █ ▁    largest bound lower.
#include <vector>

namespace heml {

/// Factors of lumped masses, #V, 1 or more, that bring the largest bound as far down as a share of the body's mass
/// can. bounds: #V, 1/s², positive where a node has elements; masses: #V, kg. Empty where nothing can be gained.
template <class Real>
std::vector<Real> mass_factors(const std::vector<Real>& bounds, const std::vector<Real>& masses, double share);

}  // namespace heml
