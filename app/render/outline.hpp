#pragma once
// The outline of a shape as an eye sees it, for smooth edges without multisampling, which costs software OpenGL as much
// as the whole picture: along each outline edge a strip one pixel wide is drawn that fades from the shape to nothing.
//
//        front face │ strip
//     ──────────────┤▒▒░░··  ← covers what a pixel beyond the edge still shows of the shape
//                   │
#include <app/render/gl_objects.hpp>
#include <span>
#include <vector>

namespace heml::render {

class Outline {
 public:
  /// A piece of the outline, and the direction away from the shape: one pixel long, in clip units at w = 1.
  struct Piece {
    std::uint32_t from, to;  ///< vertices
    Vec2f outward;
  };

  /// triangles: 3 vertices each. positions: #V×3 at rest; vertices at exactly the same place count as one.
  Outline(std::span<const std::uint32_t> triangles, std::span<const Vec3f> positions);

  /// Edges between a triangle that faces the eye and one that does not, that have one triangle only, or that are sharp
  /// and seen from both sides (they then fade into the other side); in a fixed order. eye: in the space of the
  /// positions. to_clip: from that space to the clip space of a picture of a size in pixels.
  const std::vector<Piece>& find(std::span<const Vec3f> positions, const Vec3f& eye, const Mat4f& to_clip, Size size);

  /// Six corners of two triangles for each piece: calls corner(vertex, outward, cover), cover 1 on the edge and 0
  /// outside.
  template <class Corner>
  static void for_each_corner(const std::vector<Piece>& pieces, Corner corner) {
    for (const Piece& piece : pieces)
      for (const auto& [end, outside] : {std::pair(0, 0), {1, 0}, {0, 1}, {0, 1}, {1, 0}, {1, 1}})
        corner(end == 0 ? piece.from : piece.to, outside == 0 ? Vec2f(Vec2f::Zero()) : piece.outward, 1.0f - outside);
  }

 private:
  struct Edge {
    std::uint32_t from, to;  // as the first triangle has them
    int first, second;       // triangles; second −1: none
    std::uint32_t first_apex, second_apex;
    bool sharp;  // its two triangles have vertices of their own
  };
  std::vector<std::uint32_t> triangles_;
  std::vector<Edge> edges_;
  std::vector<char> facing_;
  std::vector<Piece> pieces_;
};

}  // namespace heml::render
