#pragma once
// Meshes of a few tetrahedra that are not joined.
#include <heml/mesh/tet_mesh.hpp>
#include <random>
#include <utility>

#include "support.hpp"

namespace heml::test {

/// Appends a tetrahedron, turned so that its volume is positive.
inline void add_tet(TetMesh& mesh, const std::array<Vec3, 4>& places) {
  const auto first = static_cast<int>(mesh.nodes.size());
  Tet tet{first, first + 1, first + 2, first + 3};
  if (signed_volume(places[0], places[1], places[2], places[3]) < 0) std::swap(tet[2], tet[3]);
  mesh.nodes.insert(mesh.nodes.end(), places.begin(), places.end());
  mesh.tets.push_back(tet);
  mesh.regions.push_back(0);
}

/// Corners of a regular tetrahedron with edges of 1 round the origin, turned by R.
inline std::array<Vec3, 4> regular_tet(const Mat3& R = Mat3::Identity()) {
  const double a = 1 / std::sqrt(8.0);
  return {R * Vec3(a, a, a), R * Vec3(a, -a, -a), R * Vec3(-a, a, -a), R * Vec3(-a, -a, a)};
}

}  // namespace heml::test
