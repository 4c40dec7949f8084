#include "app/render/surface_point.hpp"

#include <algorithm>
#include <heml/math/closest.hpp>

namespace heml::render {

Vec3f SurfacePoint::among(const std::array<Vec3f, 3>& corners) const {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}

SurfacePoint surface_point(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh) {
  SurfacePoint point;
  std::array<Vec3, 3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto node = static_cast<std::size_t>(surface_mesh.triangles[static_cast<std::size_t>(hit.triangle)][k]);
    point.nodes[k] = surface_mesh.nodes[node];
    x[k] = frame.positions[node].cast<double>();
  }
  const auto weights = closest_point_weights(hit.point.cast<double>(), x[0], x[1], x[2]);
  for (std::size_t k = 0; k < 3; ++k) point.weights[k] = static_cast<float>(weights[k]);
  return point;
}

std::optional<std::size_t> surface_index(int node, const SurfaceMesh& surface_mesh) {
  const auto at = std::lower_bound(surface_mesh.nodes.begin(), surface_mesh.nodes.end(), node);
  if (at == surface_mesh.nodes.end() || *at != node) return std::nullopt;
  return static_cast<std::size_t>(at - surface_mesh.nodes.begin());
}

bool is_on(const SurfacePoint& point, const SurfaceMesh& surface_mesh) {
  std::array<int, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto index = surface_index(point.nodes[k], surface_mesh);
    if (!index) return false;
    corners[k] = static_cast<int>(*index);
  }
  return std::any_of(surface_mesh.triangles.begin(), surface_mesh.triangles.end(), [&](const auto& triangle) {
    const auto has = [&](int corner) { return std::find(triangle.begin(), triangle.end(), corner) != triangle.end(); };
    return std::all_of(corners.begin(), corners.end(), has);
  });
}

std::optional<std::array<Vec3f, 3>> corners_of(const SurfacePoint& point, const Frame& frame,
                                               const SurfaceMesh& surface_mesh) {
  std::array<Vec3f, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto index = surface_index(point.nodes[k], surface_mesh);
    if (!index) return std::nullopt;
    corners[k] = frame.positions[*index];
  }
  return corners;
}

}  // namespace heml::render
