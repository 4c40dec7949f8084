#include "app/render/pick.hpp"

#include <app/render/ray_triangle.hpp>
#include <limits>

namespace heml::render {

std::optional<Hit> pick(const Frame& frame, const Skin& skin, const Ray& ray) {
  float nearest = std::numeric_limits<float>::infinity();
  std::optional<Hit> hit;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    const auto& [a, b, c] = skin.triangles[t];
    const float distance = ray_meets(ray.origin, ray.direction, frame.positions[a], frame.positions[b],
                                     frame.positions[c]);
    if (!(distance < nearest)) continue;
    nearest = distance;
    hit = Hit{static_cast<int>(t), a, ray.origin + distance * ray.direction};
  }
  if (!hit) return hit;
  for (const int node : skin.triangles[hit->triangle])
    if ((frame.positions[node] - hit->point).squaredNorm() < (frame.positions[hit->node] - hit->point).squaredNorm())
      hit->node = node;
  return hit;
}

}  // namespace heml::render
