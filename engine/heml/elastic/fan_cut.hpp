#pragma once
// Cutting a set of tetrahedra into fans.
#include <algorithm>
#include <heml/elastic/fan_block.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Tetrahedra (p, q, ring[i], ring[i+1]) round the edge pq, each of positive volume. In a closed ring the last node is
/// followed by the first.
struct Fan {
  int p, q;
  std::vector<int> ring;          ///< one node more than tetrahedra, or as many in a closed ring
  std::vector<std::size_t> tets;  ///< indices of the tetrahedra; empty in a dummy fan that fills a lane
  FanSize size() const {
    return {static_cast<std::uint8_t>(std::max<std::size_t>(tets.size(), 1)), static_cast<std::uint8_t>(ring.size())};
  }
};

/// Cuts tetrahedra (positive volume) into fans, each tetrahedron in one of them. The result has groups of `lanes` fans
/// of one size, fan l of group g at result[g * lanes + l], sizes that read fewest nodes per tetrahedron first. Fans
/// that fill no group are opened or halved; the last group is filled with dummy fans, whose nodes are −1. Successive
/// fans of a lane are near one another, those of different lanes are not.
std::vector<Fan> cut_into_fans(const std::vector<Tet>& tets, std::size_t lanes);

}  // namespace heml
