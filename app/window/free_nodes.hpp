#pragma once
// Nodes of the drawn surface that a grasp or a pin can take: neither constrained by the scene nor pinned.
#include <app/render/pick.hpp>
#include <heml/base/status.hpp>

namespace heml::window {

class FreeNodes {
 public:
  /// Both outlive it.
  FreeNodes(const Frame& frame, const SurfaceMesh& surface_mesh);

  /// The free node nearest to a hit: of the corners of its triangle, and of nodes within `radius` (m, at rest) of its
  /// node. Index into SurfaceMesh::nodes; none: all of these are held.
  std::optional<int> nearest(const render::Hit& hit, double radius) const;
  bool is_pinned(int index) const;
  /// Why nearest() found none.
  Status why_none(const render::Hit& hit) const;

 private:
  bool is_constrained(int index) const;

  const Frame& frame_;
  const SurfaceMesh& surface_mesh_;
  std::vector<int> pinned_;  // mesh-file numbers, ascending
};

}  // namespace heml::window
