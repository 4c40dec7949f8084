#pragma once
// Cutting a set of tetrahedra into fans.
#include <algorithm>
#include <heml/elastic/fan_block.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Tetrahedra round an edge: (p, q, ring[i], ring[i+1]), each of positive volume. Where they go all round it the ring
/// is closed: after its last node comes its first.
struct Fan {
  int p, q;
  std::vector<int> ring;          ///< one more than tetrahedra, or as many: closed
  std::vector<std::size_t> tets;  ///< which of those given; empty: stands for nothing (a lane left over)
  FanSize size() const {
    return {static_cast<std::uint8_t>(std::max<std::size_t>(tets.size(), 1)), static_cast<std::uint8_t>(ring.size())};
  }
};

/// Fans that together hold each of the given tetrahedra (positive volume) once, in groups of `lanes` of the same size,
/// those that read fewest nodes a tetrahedron first: fan l of group g is result[g * lanes + l]. Fans that make no full
/// group are opened, and cut shorter; the last group is filled with fans of no tetrahedron, whose nodes are -1. The
/// fans of a lane are near one another, those of different lanes are not.
std::vector<Fan> cut_into_fans(const std::vector<Tet>& tets, std::size_t lanes);

}  // namespace heml
