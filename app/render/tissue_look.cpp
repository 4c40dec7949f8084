#include <algorithm>
#include <app/render/ambient_occlusion.hpp>
#include <app/render/bounds.hpp>
#include <app/render/smooth_surface.hpp>
#include <app/render/sphere_map.hpp>
#include <app/render/tissue_look.hpp>
#include <cassert>
#include <limits>

namespace heml::render {
namespace {

constexpr float occlusion_reach = 0.7f;  // in body radii

/// Index of each node among those of the uncut surface; −1: exposed by a cut. Both lists are ascending.
std::vector<int> places_in_whole(const SurfaceMesh& surface_mesh) {
  std::vector<int> places(surface_mesh.nodes.size(), -1);
  const std::vector<int>& nodes = surface_mesh.whole->nodes;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto at = std::lower_bound(nodes.begin(), nodes.end(), surface_mesh.nodes[i]);
    if (at != nodes.end() && *at == surface_mesh.nodes[i]) places[i] = static_cast<int>(at - nodes.begin());
  }
  return places;
}

std::vector<int> triangle_counts(const SurfaceMesh& surface_mesh) {
  std::vector<int> counts(surface_mesh.nodes.size(), 0);
  for (const Triangle& triangle : surface_mesh.triangles)
    for (const int node : triangle) ++counts[node];
  return counts;
}

std::vector<Vec3f> node_normals(const SurfaceMesh& surface_mesh) {
  const SmoothSurface surface(surface_mesh, 1);
  std::vector<Vec3f> normals(surface_mesh.rest.size(), Vec3f::Zero());
  const std::vector<int>& nodes = surface.topology().corner_nodes;
  for (std::size_t c = 0; c < nodes.size(); ++c) normals[nodes[c]] += surface.normals()[c];
  for (Vec3f& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

TissueLook tissue_look(const SurfaceMesh& surface_mesh, const TissueLook* whole) {
  assert((whole != nullptr) == (surface_mesh.whole != nullptr));
  std::vector<std::optional<Vec3f>> on_sphere;
  std::vector<std::optional<float>> known_occlusion;
  if (whole) {
    const std::vector<int> place = places_in_whole(surface_mesh);
    const std::vector<int> now = triangle_counts(surface_mesh), before = triangle_counts(*surface_mesh.whole);
    on_sphere.resize(place.size());
    known_occlusion.resize(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (place[i] < 0) continue;
      on_sphere[i] = whole->on_sphere[place[i]];
      if (now[i] == before[place[i]])
        known_occlusion[i] = whole->ambient_occlusion[place[i]];  // otherwise it is at the rim of a cut
    }
  }
  const BoundingSphere ball = bounding_sphere(uncut_surface(surface_mesh).rest);
  return {sphere_map(surface_mesh, on_sphere),
          ambient_occlusion(surface_mesh, node_normals(surface_mesh), occlusion_reach * ball.radius, known_occlusion)};
}

}  // namespace heml::render
