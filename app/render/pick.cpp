#include "app/render/pick.hpp"

#include <app/render/ray_triangle.hpp>
#include <heml/math/closest.hpp>
#include <limits>

namespace heml::render {

namespace {

bool is_met_from_inside(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, const Ray& ray) {
  const auto& [a, b, c] = surface_mesh.triangles[static_cast<std::size_t>(hit.triangle)];
  const Vec3f normal =
      (frame.positions[b] - frame.positions[a]).cross(frame.positions[c] - frame.positions[a]);
  return normal.dot(ray.direction) > 0;
}

Hit with_nearest_corner(Hit hit, const Frame& frame, const SurfaceMesh& surface_mesh) {
  for (const int node : surface_mesh.triangles[hit.triangle])
    if ((frame.positions[node] - hit.point).squaredNorm() < (frame.positions[hit.node] - hit.point).squaredNorm())
      hit.node = node;
  return hit;
}

/// number(k): index of the k-th triangle of `count`, ascending.
std::optional<Hit> pick_among(std::size_t count, const auto& number, const Frame& frame,
                              const SurfaceMesh& surface_mesh, const Ray& ray,
                              const std::optional<SectionPlane>& section) {
  float nearest = std::numeric_limits<float>::infinity();
  std::optional<Hit> hit;
  for (std::size_t k = 0; k < count; ++k) {
    const int t = number(k);
    const auto& [a, b, c] = surface_mesh.triangles[static_cast<std::size_t>(t)];
    const float distance =
        ray_meets(ray.origin, ray.direction, frame.positions[a], frame.positions[b], frame.positions[c]);
    if (!(distance < nearest)) continue;
    if (section && section->beyond(ray.origin + distance * ray.direction) > 0) continue;
    nearest = distance;
    hit = Hit{t, a, ray.origin + distance * ray.direction};
  }
  if (!hit) return hit;
  if (section && is_met_from_inside(*hit, frame, surface_mesh, ray)) return std::nullopt;
  return with_nearest_corner(*hit, frame, surface_mesh);
}

}  // namespace

std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, const Ray& ray,
                        const std::optional<SectionPlane>& section) {
  const auto same = [](std::size_t k) { return static_cast<int>(k); };
  return pick_among(surface_mesh.triangles.size(), same, frame, surface_mesh, ray, section);
}

std::optional<Hit> pick(const Frame& frame, const SurfaceMesh& surface_mesh, std::span<const int> triangles,
                        const Ray& ray, const std::optional<SectionPlane>& section) {
  const auto number = [&](std::size_t k) { return triangles[k]; };
  return pick_among(triangles.size(), number, frame, surface_mesh, ray, section);
}

std::optional<Hit> nearest_surface(const Frame& frame, const SurfaceMesh& surface_mesh, const Vec3f& point, float reach,
                                   const std::optional<SectionPlane>& section) {
  float least = reach;
  std::optional<Hit> hit;
  for (std::size_t t = 0; t < surface_mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = surface_mesh.triangles[t];
    const Vec3f &x = frame.positions[a], &y = frame.positions[b], &z = frame.positions[c];
    if ((x.cwiseMin(y).cwiseMin(z) - point).maxCoeff() > least) continue;
    if ((point - x.cwiseMax(y).cwiseMax(z)).maxCoeff() > least) continue;
    const Vec3 p = x.cast<double>(), q = y.cast<double>(), r = z.cast<double>();
    const auto weights = closest_point_weights(point.cast<double>(), p, q, r);
    const Vec3f place = (weights[0] * p + weights[1] * q + weights[2] * r).cast<float>();
    const float distance = (place - point).norm();
    if (!(distance < least) && !(distance == least && !hit)) continue;
    if (section && section->beyond(place) > 0) continue;
    least = distance;
    hit = with_nearest_corner({static_cast<int>(t), a, place}, frame, surface_mesh);
  }
  return hit;
}

std::optional<float> value_at(const Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh) {
  if (frame.field == Field::none || frame.values.size() != frame.positions.size()) return std::nullopt;
  const Triangle& triangle = surface_mesh.triangles[static_cast<std::size_t>(hit.triangle)];
  const auto corner = [&](std::size_t k) { return static_cast<std::size_t>(triangle[k]); };
  const auto place = [&](std::size_t k) -> Vec3 { return frame.positions[corner(k)].cast<double>(); };
  const auto weights = closest_point_weights(hit.point.cast<double>(), place(0), place(1), place(2));
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += weights[k] * static_cast<double>(frame.values[corner(k)]);
  return static_cast<float>(sum);
}

}  // namespace heml::render
