#pragma once
// Pin: a patch of nodes that stay exactly where they were when they were pinned, whatever pulls at them, until they are
// released. Solvers know them by their inverse mass, which is 0, as they know nodes that the scene holds.
#include <heml/math/types.hpp>
#include <span>
#include <vector>

namespace heml {

struct PinnedPatch {
  int center;               ///< inner number
  std::vector<int> nodes;   ///< inner numbers, with the centre; what cuts add to the patch comes last
  std::vector<Vec3> place;  ///< m, where each is
};

/// nodes: candidates (ascending), of which those within `radius` of `center` at rest are taken, and `center` always;
/// those whose inverse mass is 0 are held by something else, or belong to no element, and are left out. x: 3 #V, m.
template <class Real>
PinnedPatch pin_patch(int center, double radius, std::span<const int> nodes, const std::vector<Vec3>& rest,
                      const Real* x, const std::vector<Real>& inverse_mass);

/// Force of the pin on the tissue at rest, N: against all others at its nodes, f (3 #V).
template <class Real>
Vec3 pin_force(const PinnedPatch& pin, const Real* f);

}  // namespace heml
