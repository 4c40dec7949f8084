#pragma once
// Antialiasing of silhouettes: along each outline edge a strip one pixel wide fades from the shape to transparent.
// Multisampling would cost software OpenGL as much as the whole picture.
//
//        front face │ strip
//     ──────────────┤▒▒░░··  ← partial cover of the pixel beyond the edge
//                   │
#include <app/render/gl_objects.hpp>
#include <span>
#include <vector>

namespace heml::render {

class Outline {
 public:
  /// An edge of the outline, and the direction away from the shape: one pixel long, in clip units at w = 1.
  struct Piece {
    std::uint32_t from, to;  ///< vertices
    Vec2f outward;
  };

  /// triangles: 3 vertices each. same: #V, for each vertex the lowest index of those that count as one with it, because
  /// they differ in their normals alone (mesh/weld.hpp, SmoothSurface::joined_vertices).
  Outline(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> same);

  /// Edges between a front and a back face, edges of one triangle only, and sharp edges between two front faces (which
  /// fade into the other face); in a fixed order. positions: #V×3. eye: in the space of the positions. to_clip: from
  /// that space to clip space. size: of the picture, pixels.
  const std::vector<Piece>& find(std::span<const Vec3f> positions, const Vec3f& eye, const Mat4f& to_clip, Size size);

  /// Calls corner(vertex, outward, cover) for the six corners of two triangles of each piece; cover is 1 on the edge
  /// and 0 outside.
  template <class Corner>
  static void for_each_corner(const std::vector<Piece>& pieces, Corner corner) {
    for (const Piece& piece : pieces)
      for (const auto& [end, outside] : {std::pair(0, 0), {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}})
        corner(end == 0 ? piece.from : piece.to, outside == 0 ? Vec2f(Vec2f::Zero()) : piece.outward,
               outside == 0 ? 1.0f : 0.0f);
  }

 private:
  struct Edge {
    std::uint32_t from, to;  // in the orientation of the first triangle
    int first, second;       // triangles; second −1: none
    std::uint32_t first_apex, second_apex;
    bool sharp;  // its two triangles do not share vertices
  };
  std::vector<std::uint32_t> triangles_;
  std::vector<Edge> edges_;
  std::vector<char> facing_;
  std::vector<Piece> pieces_;
};

}  // namespace heml::render
