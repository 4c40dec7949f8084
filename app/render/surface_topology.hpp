#pragma once
// Connectivity of a surface mesh for smooth normals.
//
// A node on a sharp edge has several normals, one for each smooth sheet that meets there. Each pair (node, sheet) is a
// "corner"; nodes on smooth parts have one:
//
//        sheet A                       node n  = corners 4 and 7
//     4 ─────────                      4: normal of sheet A
//     7\                               7: normal of sheet B
//       \ sheet B
#include <array>
#include <heml/session/frame.hpp>
#include <span>
#include <vector>

namespace heml::render {

/// An edge of a triangle between nodes `from` < `to`.
struct SurfaceEdge {
  int from = 0, to = 0;
  struct Side {
    int from = 0, to = 0;  ///< corners at the two ends
    bool operator==(const Side&) const = default;
  };
  std::vector<Side> sides;  ///< the distinct pairs of corners: one if smooth, more if sharp
};

struct SurfaceTopology {
  std::vector<int> corner_nodes;                   ///< #C: index into SurfaceMesh::nodes
  std::vector<Triangle> triangles;                 ///< #F×3: corners
  std::vector<SurfaceEdge> edges;                  ///< #E, in ascending order of (from, to)
  std::vector<std::array<int, 3>> triangle_edges;  ///< #F×3: the edge from vertex k to vertex k+1
};

/// crease: rad; an edge is sharp if the normals of its faces differ by more than this at rest, or if it does not have
/// exactly two faces, or if only one of them is exposed (session/original_skin.hpp). exposed: #F, or empty for none.
SurfaceTopology surface_topology(const SurfaceMesh& surface_mesh, float crease, std::span<const char> exposed = {});

}  // namespace heml::render
