#pragma once
// The body on the graphics card: its smooth surface, the true edges on it, and the held nodes.
#include <app/render/bounds.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/gl_objects.hpp>
#include <app/render/outline.hpp>
#include <app/render/smooth_surface.hpp>
#include <app/render/tissue_look.hpp>
#include <span>

namespace heml::render {

class BodyMesh {
 public:
  BodyMesh(const SurfaceMesh& surface_mesh, const TissueLook& look);

  /// Takes a frame's positions and, when it has them, its values over a range.
  void update(const Frame& frame, const Range& range);

  /// Values above 0 are hatched by programs that do so; #S, or empty for none.
  void update_hatching(std::span<const float> beyond);

  /// Finds the outline as an eye (m) sees it, for draw_outline().
  void update_outline(const Vec3f& eye, const Mat4f& view_projection, Size size);

  void draw_surface() const;
  void draw_outline() const;  ///< strips that fade outwards, see outline.hpp
  void draw_flat() const;     ///< the real triangles, for shadows
  void draw_edges() const;
  void draw_constrained() const;  ///< points

  const BoundingSphere& rest() const {
    return rest_;
  }  ///< of the whole body: what is removed moves neither ground nor light
  float bead_radius() const { return bead_radius_; }  ///< m, for held nodes
  bool has_triangles() const { return !surface_.triangles().empty(); }
  std::size_t node_count() const { return nodes_; }

 private:
  // Follows the body, each frame.
  struct Moving {
    Vec3f position, normal;
    float value;  // 0..1 over the range
  };
  // Stays with the tissue.
  struct Fixed {
    Vec3f rest;       // in body radii about the body's centre
    Vec3f on_sphere;  // sphere_map.hpp
    std::array<std::uint8_t, 4> surface;
  };
  struct Strip {
    Moving moving;
    Fixed fixed;
    Vec3f strip;  // clip offset, cover
  };
  struct Indices {
    Buffer buffer;
    GLsizei count = 0;
  };

  void describe_vertices();
  void upload_fixed(const SurfaceMesh& surface_mesh, const TissueLook& look);
  void upload_indices(const SurfaceMesh& surface_mesh);
  void draw(GLenum mode, const Indices& indices) const;

  SmoothSurface surface_;
  std::size_t nodes_;
  BoundingSphere rest_;
  float bead_radius_ = 0;
  std::vector<float> values_, beyond_;
  Outline outline_;
  std::vector<Moving> moving_;
  std::vector<Fixed> fixed_;
  std::vector<Strip> strips_;
  VertexArray array_, strip_array_;
  Buffer moving_buffer_, fixed_buffer_, strip_buffer_, beyond_buffer_;
  Indices triangles_, flat_, lines_, constrained_;
};

}  // namespace heml::render
