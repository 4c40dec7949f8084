#pragma once
// Vertex buffers of the body: its smooth surface, the edges of the mesh, and the constrained nodes.
#include <app/render/bounds.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/gl_objects.hpp>
#include <app/render/outline.hpp>
#include <app/render/smooth_surface.hpp>
#include <app/render/tissue_look.hpp>
#include <app/render/wound.hpp>
#include <span>

namespace heml::render {

class BodyMesh {
 public:
  /// wound: of a surface with edits; none, or one without exposed faces, otherwise.
  BodyMesh(const SurfaceMesh& surface_mesh, const TissueLook& look, std::optional<Wound> wound = std::nullopt);

  /// Uploads the positions of a frame and, if it has any, its values, scaled to a range.
  void update(const Frame& frame, const Range& range);

  /// Uploads the values that programs with HATCH hatch where above 0; #S, or empty for none.
  void update_hatching(std::span<const float> beyond);

  /// Finds the outline as seen from `eye` (m), for draw_outline().
  void update_outline(const Vec3f& eye, const Mat4f& view_projection, Size size);

  /// Where the surface's nodes are drawn since update(), with lips parted; #S, or empty without a wound.
  std::span<const Vec3f> placed() const { return placed_; }

  void draw_skin() const;
  void draw_skin_outline() const;  ///< strips that fade outwards, see outline.hpp
  bool has_wound() const { return wound_.has_value(); }
  void draw_wound() const;  ///< faces that cuts, tears and removals have exposed
  void draw_wound_outline() const;
  void draw_flat() const;  ///< the triangles of the mesh, for shadows
  void draw_edges() const;
  void draw_constrained() const;  ///< as points

  /// At rest, of the uncut body, so that removals move neither ground nor light.
  const BoundingSphere& rest() const { return rest_; }
  float bead_radius() const { return bead_radius_; }  ///< m, for constrained nodes
  bool is_burnt() const { return is_burnt_; }
  bool has_triangles() const { return !surface_.triangles().empty(); }
  std::size_t node_count() const { return nodes_; }

 private:
  // Vertex data that change with each frame.
  struct Moving {
    Vec3f position, normal;
    float value;  // 0..1 over the range; without values, of a wound: Wound::openness
  };
  // Vertex data at rest.
  struct Fixed {
    Vec3f rest;       // in body radii about the body's centre
    Vec3f on_sphere;  // sphere_map.hpp
    std::array<std::uint8_t, 4> surface;
    float depth = 0;  // of a wound, below the original skin, in body radii
    float burnt = 0;  // SurfaceMesh::burnt
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
  void find_wound_vertices();
  void draw_strips(std::size_t first, std::size_t last) const;
  void draw(GLenum mode, const Indices& indices) const;

  std::optional<Wound> wound_;  // with exposed faces
  SmoothSurface surface_;
  std::size_t nodes_;
  BoundingSphere rest_;
  bool is_burnt_;
  float bead_radius_ = 0;
  std::span<const Vec3f> placed_;
  std::vector<float> values_, beyond_;
  std::vector<char> in_wound_;  // #P; empty without a wound
  Outline outline_;
  std::vector<Moving> moving_;
  std::vector<Fixed> fixed_;
  std::vector<Strip> strips_;
  std::size_t skin_strips_ = 0;  // the first ones; those of the wound follow
  VertexArray array_, strip_array_;
  Buffer moving_buffer_, fixed_buffer_, strip_buffer_, beyond_buffer_;
  Indices skin_, raw_, flat_, lines_, constrained_;
};

}  // namespace heml::render
