#pragma once
// Cutting a set of tetrahedra into fans.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Tetrahedra round an edge: (p, q, ring[i], ring[i+1]), each of positive volume.
struct Fan {
  int p, q;
  std::vector<int> ring;          ///< tetrahedra + 1
  std::vector<std::size_t> tets;  ///< which of those given; empty: stands for nothing (a lane left over)
};

/// Fans that together hold each of the given tetrahedra (positive volume) once, in groups of `lanes` of the same
/// length, longest first: fan l of group g is result[g * lanes + l]. Fans that make no full group are cut shorter; the
/// last group is filled with fans of no tetrahedron, whose nodes are -1. The fans of a lane are near one another, those
/// of different lanes are not.
std::vector<Fan> cut_into_fans(const std::vector<Tet>& tets, std::size_t lanes);

}  // namespace heml
