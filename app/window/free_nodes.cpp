#include <algorithm>
#include <app/window/free_nodes.hpp>
#include <limits>

namespace heml::window {

FreeNodes::FreeNodes(const Frame& frame, const SurfaceMesh& surface_mesh) : frame_(frame), surface_mesh_(surface_mesh) {
  for (const PinState& pin : tools_of<PinState>(frame.tools))
    pinned_.insert(pinned_.end(), pin.nodes.begin(), pin.nodes.end());
  std::sort(pinned_.begin(), pinned_.end());
}

bool FreeNodes::is_constrained(int index) const {
  return std::binary_search(surface_mesh_.constrained.begin(), surface_mesh_.constrained.end(), index);
}

bool FreeNodes::is_pinned(int index) const {
  return std::binary_search(pinned_.begin(), pinned_.end(), surface_mesh_.nodes[static_cast<std::size_t>(index)]);
}

std::optional<int> FreeNodes::nearest(const render::Hit& hit, double radius) const {
  if (!is_constrained(hit.node) && !is_pinned(hit.node)) return hit.node;
  std::optional<int> best;
  float least = std::numeric_limits<float>::infinity();
  const auto offer = [&](int index) {
    const float distance = (frame_.positions[static_cast<std::size_t>(index)] - hit.point).norm();
    if (!(distance < least) || is_constrained(index) || is_pinned(index)) return;
    least = distance;
    best = index;
  };
  const Vec3f& centre = surface_mesh_.rest[static_cast<std::size_t>(hit.node)];
  for (std::size_t n = 0; n < surface_mesh_.rest.size(); ++n)
    if (static_cast<double>((surface_mesh_.rest[n] - centre).norm()) <= radius) offer(static_cast<int>(n));
  for (const int corner : surface_mesh_.triangles[static_cast<std::size_t>(hit.triangle)]) offer(corner);
  return best;
}

Status FreeNodes::why_none(const render::Hit& hit) const {
  return is_pinned(hit.node) ? "This tissue is pinned: the pin tool (N) frees it, a larger radius reaches beside it."
                             : "These nodes are constrained by the scene; pick others.";
}

}  // namespace heml::window
