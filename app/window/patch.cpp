#include <algorithm>
#include <app/window/patch.hpp>

namespace heml::window {

std::vector<int> elements_round(int node, const Skin& skin, double radius) {
  std::vector<int> elements;
  const auto found = std::lower_bound(skin.nodes.begin(), skin.nodes.end(), node);
  if (found == skin.nodes.end() || *found != node) return elements;
  const int centre = static_cast<int>(found - skin.nodes.begin());
  const auto at = [&](int n) { return skin.rest[static_cast<std::size_t>(n)]; };
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const auto& [a, b, c] = skin.triangles[t];
    const bool touches = a == centre || b == centre || c == centre;
    const Vec3f middle = (at(a) + at(b) + at(c)) / 3;
    if (touches || static_cast<double>((middle - at(centre)).norm()) <= radius) elements.push_back(skin.elements[t]);
  }
  std::sort(elements.begin(), elements.end());
  elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
  return elements;
}

}  // namespace heml::window
