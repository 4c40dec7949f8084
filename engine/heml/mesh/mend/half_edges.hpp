#pragma once
// What lies across each edge of a surface that may be damaged. Half-edge 3·triangle + i goes from the triangle's corner
// i to the next one.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct HalfEdges {
  static constexpr int open = -1;     ///< no other triangle has the edge
  static constexpr int crowded = -2;  ///< two or more others have it
  std::vector<int> across;            ///< 3 #F, the other half-edge of the edge, `open` or `crowded`

  static int next(int half) { return half % 3 == 2 ? half - 2 : half + 1; }
  static int from(const TriangleMesh& surface, int half) { return surface.triangles[half / 3][half % 3]; }
  static int to(const TriangleMesh& surface, int half) { return from(surface, next(half)); }
};

/// Matches half-edges by their nodes, whatever their directions.
HalfEdges find_half_edges(const TriangleMesh& surface);

}  // namespace heml
