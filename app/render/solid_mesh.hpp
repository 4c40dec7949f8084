#pragma once
// Meshes of instruments, built from tubes.
#include <app/render/gl_objects.hpp>
#include <app/render/outline.hpp>
#include <vector>

namespace heml::render {

/// Vertices with normals, and triangles.
struct SolidShape {
  struct Vertex {
    Vec3f position, normal;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> triangles;
};

/// An elliptic cross-section of a tube: its centre and semi-axes, `width` across and `depth` along `depth_axis`.
struct Ring {
  Vec3f centre;
  float width = 0, depth = 0;
};

/// Adds a tube through the rings with closed ends. depth_axis: unit, never along the tube.
void add_tube(SolidShape& shape, const std::vector<Ring>& rings, const Vec3f& depth_axis);

/// Adds a ball.
void add_ball(SolidShape& shape, const Vec3f& centre, float radius);

/// A rod from the origin to (0, 1, 0) of radius 1.
SolidShape rod();

/// One jaw of forceps that point down, at x ≥ 0: its tip at the origin, the joint with the other at (0, 1, 0).
SolidShape forceps_jaw();

/// A ball of radius 1 about the origin.
SolidShape ball();

/// A disc: radius 1, its top at y = 0, its bottom at y = −1. The top has rings of vertices, for shadows.
SolidShape disc();

/// A pin with its point at the origin and its head at (0, 1, 0).
SolidShape needle();

/// A scalpel's blade: cutting edge from its tip at the origin to (0, 1, 0), back at x = 1.
SolidShape scalpel_blade();

/// A scalpel's handle from the origin to (0, 1, 0), flat along x.
SolidShape scalpel_handle();

/// One half of scissors: blade from the pivot at the origin to its tip at (0, 1, 0), grip with its ring at x < 0 below.
SolidShape scissors_half();

class SolidMesh {
 public:
  explicit SolidMesh(SolidShape shape);
  void draw() const;
  const Eigen::AlignedBox3f& box() const { return box_; }  ///< of its shape
  /// Draws the strips along its outline (outline.hpp). eye: in the shape's space. to_clip: from that space to clip
  /// space.
  void draw_outline(const Vec3f& eye, const Mat4f& to_clip, Size size);

 private:
  struct Strip {
    SolidShape::Vertex vertex;
    Vec3f strip;  // clip offset, cover
  };
  SolidShape shape_;
  std::vector<Vec3f> positions_;
  Eigen::AlignedBox3f box_;
  Outline outline_;
  std::vector<Strip> strips_;
  VertexArray array_, strip_array_;
  Buffer vertices_, triangles_, strip_buffer_;
};

}  // namespace heml::render
