#pragma once
// Whether a surface runs through itself.
#include <cstddef>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Intersections {
  std::size_t pairs = 0;        ///< of triangles; counting stops at `max_pairs`
  int first = -1, second = -1;  ///< the lowest pair found
  std::vector<int> triangles;   ///< all that are in a pair, ascending
};
inline constexpr std::size_t max_pairs = 10'000;

/// Pairs of triangles that cross, overlap or touch other than in nodes and edges they share. Triangles must have areas,
/// edges at most two triangles. What rounding leaves open counts as touching.
Intersections self_intersections(const TriangleMesh& surface);

}  // namespace heml
