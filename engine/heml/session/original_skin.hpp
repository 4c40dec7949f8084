#pragma once
// The surface of the body before any cut, tear or removal: which faces of the present surface are parts of it, and how
// deep the others lie below it.
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml {

class OriginalSkin {
 public:
  /// surface_mesh: with `whole`.
  explicit OriginalSkin(const SurfaceMesh& surface_mesh);

  /// The nearest point of the original skin: a weighted mean of nodes of `whole`.
  struct Place {
    Triangle nodes;
    std::array<float, 3> weights;
    float depth;  ///< m, distance from the point asked for
  };
  Place nearest(const Vec3f& rest) const;
  /// nearest() of each node of the present surface, #S.
  const std::vector<Place>& places() const { return places_; }

  /// #F: whether cuts, tears or removals have exposed a face.
  const std::vector<char>& exposed() const { return exposed_; }

  /// m: points within it lie on the original skin.
  double tolerance() const { return tolerance_; }
  const SurfaceTree& tree() const { return tree_; }

 private:
  bool is_on_skin(const Vec3f& rest) const { return tree_.is_within(rest.cast<double>(), tolerance_); }
  void place_nodes(const SurfaceMesh& surface_mesh);
  void find_exposed(const SurfaceMesh& surface_mesh);

  SurfaceTree tree_;
  double tolerance_ = 0;  ///< m, above the rounding of nodes added on edges
  std::vector<Place> places_;
  std::vector<char> exposed_;
};

}  // namespace heml
