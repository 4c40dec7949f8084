#pragma once
// Shapes of instruments, made of tubes.
#include <app/render/gl_objects.hpp>
#include <app/render/outline.hpp>
#include <vector>

namespace heml::render {

/// Triangles with normals, ready for the graphics card.
struct SolidShape {
  struct Vertex {
    Vec3f position, normal;
  };
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> triangles;
};

/// A ring of a tube: its centre, and half its width across and along `depth_axis`.
struct Ring {
  Vec3f centre;
  float width = 0, depth = 0;
};

/// Adds a tube of elliptic rings with closed ends. depth_axis: unit, never along the tube.
void add_tube(SolidShape& shape, const std::vector<Ring>& rings, const Vec3f& depth_axis);

/// Adds a ball.
void add_ball(SolidShape& shape, const Vec3f& centre, float radius);

/// A rod from the origin to (0, 1, 0), of radius 1 across.
SolidShape rod();

/// Forceps that point down: tips together at the origin, the end at (0, 1, 0).
SolidShape forceps();

/// A ball of radius 1 about the origin.
SolidShape ball();

/// A round table: radius 1, its top at y = 0, its bottom at y = −1.
SolidShape disc();

/// A pin that stands on its point at the origin, its head at (0, 1, 0).
SolidShape needle();

class SolidMesh {
 public:
  explicit SolidMesh(SolidShape shape);
  void draw() const;
  /// The strips along its outline (outline.hpp). eye: in the shape's space. to_clip: from the shape's space.
  void draw_outline(const Vec3f& eye, const Mat4f& to_clip, Size size);

 private:
  struct Strip {
    SolidShape::Vertex vertex;
    Vec3f strip;  // clip offset, cover
  };
  SolidShape shape_;
  std::vector<Vec3f> positions_;
  Outline outline_;
  std::vector<Strip> strips_;
  VertexArray array_, strip_array_;
  Buffer vertices_, triangles_, strip_buffer_;
};

}  // namespace heml::render
