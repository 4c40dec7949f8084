#pragma once
// Pin: a patch of nodes that stays exactly where it was when pinned, until released. Its nodes get an inverse mass of
// 0, as nodes constrained by the scene have.
#include <heml/math/types.hpp>
#include <span>
#include <vector>

namespace heml {

struct PinnedPatch {
  int center;                   ///< internal number
  std::vector<int> nodes;       ///< internal numbers, with the centre; nodes that cuts add to the patch come last
  std::vector<Vec3> positions;  ///< m, position of each
};

/// Pins `center` and those of `nodes` (ascending) within `radius` (m) of it at rest, except nodes of inverse mass 0,
/// which are constrained already or belong to no element. rest, x: #V×3, m. inverse_mass: #V, 1/kg.
template <class Real>
PinnedPatch pin_patch(int center, double radius, std::span<const int> nodes, const std::vector<Vec3>& rest,
                      const Real* x, const std::vector<Real>& inverse_mass);

/// Pins those of `nodes` (ascending) that are free; the centre is the first of them. None is free: without nodes.
template <class Real>
PinnedPatch pin_list(std::span<const int> nodes, const Real* x, const std::vector<Real>& inverse_mass);

/// Lets go of those of `nodes` (ascending) that the pin holds; returns whether it held any. A centre that goes is
/// followed by the first node that stays.
bool take_nodes(PinnedPatch& pin, std::span<const int> nodes);

/// Force of the pin on the tissue in equilibrium, N: minus the sum of the other forces f (#V×3, N) at its nodes.
template <class Real>
Vec3 pin_force(const PinnedPatch& pin, const Real* f);

}  // namespace heml
