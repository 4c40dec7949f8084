#pragma once
// Vertex buffers of the face on which a section plane cuts the body open.
#include <app/render/body_mesh.hpp>
#include <app/render/section_cut.hpp>
#include <heml/mesh/improve/surface_tree.hpp>

namespace heml::render {

class SectionCap {
 public:
  /// Cuts the frame's solid and uploads the face; empty for a frame without a solid. rest: of the uncut body.
  void update(const Frame& frame, const SectionPlane& plane, const Range& range, const BoundingSphere& rest);
  void draw() const;  ///< with tissue.vert and CAP
  bool is_burnt() const { return solid_ && !solid_->burnt.empty(); }

 private:
  /// As BodyMesh: attributes of tissue.vert.
  struct Vertex {
    Vec3f position, normal;
    float value;  // 0..1 over the range; without values: fully open
    Vec3f rest;   // in body radii about the body's centre
    std::array<std::uint8_t, 4> surface;
    float depth;  // below the original skin, in body radii
    float burnt;  // Solid::burnt
  };
  void adopt(const Frame& frame);
  float depth_of(int node);

  std::shared_ptr<const Solid> solid_;        // the one of depths_
  std::shared_ptr<const SurfaceMesh> whole_;  // the one of skin_
  std::optional<SurfaceTree> skin_;
  std::vector<float> depths_;                 // m, of nodes below the original skin; not a number: not yet found
  std::vector<Vertex> vertices_;
  VertexArray array_;
  Buffer buffer_;
};

}  // namespace heml::render
