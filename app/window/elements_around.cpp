#include <algorithm>
#include <app/window/elements_around.hpp>

namespace heml::window {

std::vector<int> elements_around(int node, const SurfaceMesh& surface_mesh, double radius) {
  std::vector<int> elements;
  const auto found = std::lower_bound(surface_mesh.nodes.begin(), surface_mesh.nodes.end(), node);
  if (found == surface_mesh.nodes.end() || *found != node) return elements;
  const int centre = static_cast<int>(found - surface_mesh.nodes.begin());
  const auto at = [&](int n) { return surface_mesh.rest[static_cast<std::size_t>(n)]; };
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = surface_mesh.triangles[t];
    const bool touches = a == centre || b == centre || c == centre;
    const Vec3f middle = (at(a) + at(b) + at(c)) / 3;
    if (touches || static_cast<double>((middle - at(centre)).norm()) <= radius)
      elements.push_back(surface_mesh.elements[t]);
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

}  // namespace heml::window
