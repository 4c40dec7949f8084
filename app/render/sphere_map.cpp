#include "app/render/sphere_map.hpp"

#include <algorithm>
#include <app/render/bounds.hpp>

namespace heml::render {
namespace {

constexpr int rounds = 200;

void normalize_all(std::vector<Vec3f>& places, const Vec3f& centre) {
  for (Vec3f& place : places) {
    const Vec3f direction = place - centre;
    const float length = direction.norm();
    if (length > 1e-6f) {
      place = direction / length;
    } else {
      place = Vec3f::UnitY();
    }
  }
}

}  // namespace

std::vector<Vec3f> sphere_map(const SurfaceMesh& surface_mesh) {
  std::vector<Vec3f> places = surface_mesh.rest;
  normalize_all(places, bounding_sphere(surface_mesh.rest).centre);
  std::vector<Vec3f> sums(places.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < places.size(); ++i) sums[i] = 0.5f * places[i];
    Vec3f mean = Vec3f::Zero();
    float area = 0;
    for (const auto& [a, b, c] : surface_mesh.triangles) {
      const float weight =
          (surface_mesh.rest[b] - surface_mesh.rest[a]).cross(surface_mesh.rest[c] - surface_mesh.rest[a]).norm();
      const Vec3f sum = places[a] + places[b] + places[c];
      mean += weight * sum / 3;
      area += weight;
      for (const int node : {a, b, c}) sums[node] += sum - places[node];
    }
    places = sums;
    normalize_all(places, Vec3f::Zero());
    // Recentres the map, which would otherwise drift to one side.
    if (area > 0) normalize_all(places, 0.5f * mean / area);
  }
  return places;
}

}  // namespace heml::render
