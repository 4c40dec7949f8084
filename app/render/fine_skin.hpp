#pragma once
// Vertex buffers of a fine surface over the body (scenario/skin.hpp): its vertices hang on tetrahedra, so every frame
// moves them and finds their normals anew, in parallel. Colours come from its texture or vertices, or are those of
// tissue, taken from the nearest place of the body's surface, as are fields.
#include <app/render/bounds.hpp>
#include <app/render/field_colours.hpp>
#include <app/render/gl_objects.hpp>
#include <app/render/outline.hpp>
#include <app/render/tissue_look.hpp>
#include <heml/base/thread_team.hpp>
#include <heml/scenario/skin.hpp>
#include <optional>
#include <span>

namespace heml::render {

class FineSkin {
 public:
  /// body: the surface that the skin is of; look: its look; rest: the bounding ball of the uncut one. last: a skin
  /// whose texture is taken over if it has the same; else the texture is read. Throws InputError.
  FineSkin(std::shared_ptr<const Skin> skin, const SurfaceMesh& body, const TissueLook& look,
           const BoundingSphere& rest, FineSkin* last = nullptr);

  const std::shared_ptr<const Skin>& source() const { return skin_; }
  bool is_painted() const { return painted_; }  ///< with colours of its own
  const Texture& texture() const { return texture_; }

  /// Takes what is burnt of the body's surface (SurfaceMesh::burnt).
  void set_burnt(std::span<const float> burnt);
  bool is_burnt() const { return is_burnt_; }

  /// Moves the surface with a frame that has a solid; values are scaled to a range. placed: where the nodes of a cut
  /// body's surface are drawn (Wound::place()); empty: where they are.
  void update(const Frame& frame, const Range& range, std::span<const Vec3f> placed = {});
  /// As BodyMesh::update_hatching().
  void update_hatching(std::span<const float> beyond);
  /// As BodyMesh::update_outline().
  void update_outline(const Vec3f& eye, const Mat4f& view_projection, Size size);

  void draw() const;
  void draw_outline() const;

  const std::vector<Vec3f>& positions() const { return positions_; }  ///< #V, of the last update
  const std::vector<Vec3f>& normals() const { return normals_; }      ///< #V, unit, the same along seams

 private:
  struct Moving {
    Vec3f position, normal;
    float value;
  };
  struct Fixed {
    Vec3f rest, on_sphere;                // as in BodyMesh
    std::array<std::uint8_t, 4> surface;  // as in BodyMesh
    Vec2f place;                          // in the texture
    std::array<std::uint8_t, 4> colour;
    float burnt = 0;
  };
  struct Strip {
    Moving moving;
    Fixed fixed;
    Vec3f strip;
  };
  /// The nearest place on the body's surface: nodes and weights.
  struct Anchor {
    Triangle nodes;
    std::array<float, 3> weights;
  };

  void find_anchors(const SurfaceMesh& body);
  void take_anchors(const SurfaceMesh& body);
  void find_fans();
  void upload_fixed(const TissueLook& look, const BoundingSphere& rest);
  void upload_texture(FineSkin* last);
  void describe_vertices();
  void move(const Frame& frame, std::span<const Vec3f> placed);
  void find_normals();
  template <class Value>
  Value value_at(std::size_t vertex, std::span<const Value> of_nodes) const;

  std::shared_ptr<const Skin> skin_;
  bool painted_ = false, is_burnt_ = false;
  ThreadTeam team_;
  std::vector<Anchor> anchors_;           // #V
  std::vector<int> regions_;              // #V, of the body's surface below
  std::vector<std::uint32_t> indices_;    // 3 a triangle
  std::vector<std::uint32_t> same_;       // #V: the lowest vertex at the same place at rest
  std::vector<std::uint32_t> fan_first_;  // #V+1, of fans_: the triangles round each vertex that is its own `same_`
  std::vector<std::uint32_t> fans_;
  std::vector<Vec3f> positions_, normals_, face_normals_;
  std::vector<float> beyond_;
  std::vector<Moving> moving_;
  std::vector<Fixed> fixed_;
  std::vector<Strip> strips_;
  std::optional<Outline> outline_;
  VertexArray array_, strip_array_;
  Buffer moving_buffer_, fixed_buffer_, strip_buffer_, beyond_buffer_, index_buffer_;
  Texture texture_;
};

}  // namespace heml::render
