#pragma once
// The wounds of a body: the faces that cuts, tears and removals have exposed, the shape in which they and the skin
// beside them are drawn, and how far they gape.
#include <app/render/lip_shape.hpp>
#include <span>

namespace heml::render {

class Wound {
 public:
  /// surface_mesh: with `whole`. radius: of the body at rest, m.
  Wound(const SurfaceMesh& surface_mesh, float radius);

  bool empty() const { return sites_.empty(); }
  const OriginalSkin& skin() const { return skin_; }
  const std::vector<char>& exposed() const { return skin_.exposed(); }  ///< #F

  /// Where nodes are drawn: lips smoothed and parted (lip_shape.hpp). nodes: #S×3, m. Two lips that lie together get
  /// mirrored displacements. Valid until the next call.
  const std::vector<Vec3f>& place(std::span<const Vec3f> nodes);

  /// #S, of the last place(): light from outside that reaches a node of an exposed face, 0 to 1: 1 in a wound that
  /// gapes, 0 deep in a closed one.
  const std::vector<float>& openness() const { return openness_; }

 private:
  /// A displacement in the frame of two edges at the node: u (a − node) + v (b − node) + w × their unit normal.
  struct Shift {
    int node, a, b;
    float u, v, w;
  };
  void attach(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& displacements);
  void update_openness();

  OriginalSkin skin_;
  float radius_;
  std::vector<WoundSite> sites_;
  std::vector<Shift> shifts_;
  std::vector<Vec3f> placed_;
  std::vector<float> openness_;
};

}  // namespace heml::render
