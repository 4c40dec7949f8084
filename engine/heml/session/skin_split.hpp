#pragma once
// A fine surface divided along the rim of a wound. Through each edge of the rim goes a curtain, outward and inward
// along the normals of the body's surface, and where it crosses the fine surface that gets an edge:
//
//          n        n
//     ·····│·····   │          fine surface ·····, body's surface ───
//     ─────a───────·│·····     a, b: nodes of the rim; the curtain stands on the edge between them
//                ───b─────
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/session/wound_rim.hpp>
#include <map>

namespace heml {

struct SplitSkin {
  /// A point that divides the surface.
  struct Point {
    Vec3 place;  ///< m, at rest
    Vec3 foot;   ///< the nearest point of the rim's edge
  };
  /// A part of a triangle that is divided.
  struct Part {
    int triangle;
    std::array<int, 3> corners;   ///< vertices of the surface; from its number of vertices on: points
    std::array<Vec3, 3> weights;  ///< of the triangle's corners
  };
  std::vector<Point> points;
  std::vector<Part> parts;  ///< ascending in `triangle`
  /// Edges that part the surface, by the points that they lead from and to, in both directions: the face of the body's
  /// surface on the left, as seen from above; −1: there is none.
  std::map<std::array<int, 2>, int> along_rim;
  std::vector<int> near;  ///< triangles about the curtains, ascending
};

/// A fine surface of #V vertices, to be divided.
struct DividedSurface {
  const SurfaceTree& surface;
  const std::vector<std::uint32_t>& same;  ///< #V: the lowest vertex at the same place
  const std::vector<std::size_t>& first;   ///< #V+1
  const std::vector<int>& around;          ///< from first[v] to first[v + 1]: the triangles at a vertex that is its `same`
};

/// reach: m, of the curtains, outward and inward. Triangles that face away from the body's surface are not divided.
SplitSkin split_along(const WoundRim& rim, const DividedSurface& skin, double reach);

}  // namespace heml
