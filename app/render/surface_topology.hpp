#pragma once
// How the triangles of a skin hang together, fixed while the skin is.
//
// A node on a sharp edge is seen with several normals, one for each smooth sheet that meets there. Each (node, sheet)
// is a "corner"; nodes on smooth parts have one:
//
//        sheet A                       node n  = corners 4 and 7
//     4 ─────────                      4: normal of sheet A
//     7\                               7: normal of sheet B
//       \ sheet B
#include <array>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

/// An edge a triangle has, going from node `from` to node `to`, from < to.
struct SurfaceEdge {
  int from = 0, to = 0;
  struct Side {
    int from = 0, to = 0;  ///< corners at the two ends
    bool operator==(const Side&) const = default;
  };
  std::vector<Side> sides;  ///< one for each different pair of corners: one where smooth, more where sharp
};

struct SurfaceTopology {
  std::vector<int> corner_nodes;                   ///< #C: index into Skin::nodes
  std::vector<Triangle> triangles;                 ///< #F×3: corners
  std::vector<SurfaceEdge> edges;                  ///< #E, in ascending order of (from, to)
  std::vector<std::array<int, 3>> triangle_edges;  ///< #F×3: the edge from vertex k to vertex k+1
};

/// crease: radians; an edge whose faces turn by more than this at rest is sharp. So is one that is not shared by
/// exactly two.
SurfaceTopology surface_topology(const SurfaceMesh& surface_mesh, float crease);

}  // namespace heml::render
