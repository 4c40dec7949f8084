#pragma once
// Smooth display of the deformed surface: vertex normals, and every triangle replaced with a curved patch through its
// nodes (PN triangles: Vlachos, Peters, Boyd and Mitchell, "Curved PN triangles", I3D 2001). Each triangle becomes
// `segments`² small ones; patches join without cracks, because neighbours share the positions along their edge.
//
// Order of vertices: corners (surface_topology.hpp), vertices inside edges, vertices inside triangles.
#include <app/render/surface_topology.hpp>
#include <array>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace heml::render {

/// rad; edges of the mesh that are sharper at rest stay sharp.
inline constexpr float crease_angle = 70 * std::numbers::pi_v<float> / 180;

class SmoothSurface {
 public:
  /// A vertex as a weighted mean of three corners: exact for values that vary linearly over a triangle.
  struct Blend {
    Triangle corners;
    std::array<float, 3> weights;
  };

  /// segments: subdivisions of every edge; 1 leaves the triangles flat. exposed: #F, faces of wounds, whose rim is a
  /// crease smoothed along itself: a Catmull-Rom curve, the same on two lips that lie together; or empty.
  SmoothSurface(const SurfaceMesh& surface_mesh, int segments, std::span<const char> exposed = {});

  /// Segments for a surface of so many triangles: subdivided surfaces get at most 20,000 small ones.
  static int suitable_segments(std::size_t triangles);

  /// Recomputes positions and normals. nodes: #S×3, m. Allocates only in the first call.
  void update(std::span<const Vec3f> nodes);

  const std::vector<Vec3f>& positions() const { return positions_; }  ///< #P×3, m
  const std::vector<Vec3f>& normals() const { return normals_; }      ///< #P×3, unit (zero where undefined)
  const std::vector<Blend>& blends() const { return blends_; }        ///< #P
  const SurfaceTopology& topology() const { return topology_; }

  /// Small triangles, 3 vertices each; segments² for each triangle of the mesh, in its order.
  const std::vector<std::uint32_t>& triangles() const { return triangles_; }
  const std::vector<std::uint32_t>& lines() const { return lines_; }  ///< 2 per segment of an edge of the mesh

  /// For each vertex, the lowest index of a vertex at the same place of the mesh: on all sheets of a sharp edge.
  std::vector<std::uint32_t> joined_vertices() const;

  /// Interpolates values at nodes (#S) to vertices (#P), linearly over each triangle.
  template <class Value>
  void spread(std::span<const Value> nodes, std::vector<Value>& vertices) const {
    vertices.resize(blends_.size());
    for (std::size_t p = 0; p < blends_.size(); ++p) {
      const auto& [c, w] = blends_[p];
      vertices[p] = w[0] * nodes[topology_.corner_nodes[c[0]]] + w[1] * nodes[topology_.corner_nodes[c[1]]] +
                    w[2] * nodes[topology_.corner_nodes[c[2]]];
    }
  }

 private:
  void number_edges();
  void find_rim(std::span<const char> exposed);
  void update_rim(std::span<const Vec3f> nodes);
  void number_triangles();
  std::uint32_t edge_vertex(int triangle, int side, int step) const;
  void update_corner_normals();
  void update_edges(std::span<const Vec3f> nodes);
  void update_interiors(std::span<const Vec3f> nodes);

  SurfaceTopology topology_;
  int segments_;
  std::vector<std::vector<std::uint32_t>> edge_first_;  // #E × sides: first of the segments−1 vertices
  std::uint32_t interior_first_ = 0;
  std::vector<Blend> blends_;
  std::vector<std::uint32_t> triangles_, lines_;
  /// An edge of a wound's rim and the nodes next to its ends along the rim; −1: the rim ends there.
  struct RimEdge {
    int edge, before, after;
  };
  std::vector<RimEdge> rim_;
  std::vector<std::array<Vec3f, 2>> controls_;  // #E: Bézier control points near `from` and `to`
  std::vector<Vec3f> positions_, normals_;
};

}  // namespace heml::render
