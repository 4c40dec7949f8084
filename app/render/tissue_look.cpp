#include <algorithm>
#include <app/render/ambient_occlusion.hpp>
#include <app/render/bounds.hpp>
#include <app/render/smooth_surface.hpp>
#include <app/render/sphere_map.hpp>
#include <app/render/tissue_look.hpp>

namespace heml::render {
namespace {

constexpr float occlusion_reach = 0.7f;  // in body radii
constexpr std::size_t max_known = 8;

std::vector<Vec3f> node_normals(const SurfaceMesh& surface_mesh) {
  const SmoothSurface surface(surface_mesh, 1);
  std::vector<Vec3f> normals(surface_mesh.rest.size(), Vec3f::Zero());
  const std::vector<int>& nodes = surface.topology().corner_nodes;
  for (std::size_t c = 0; c < nodes.size(); ++c) normals[nodes[c]] += surface.normals()[c];
  for (Vec3f& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

TissueLook tissue_look(const SurfaceMesh& surface_mesh) {
  const float reach = occlusion_reach * bounding_sphere(surface_mesh.rest).radius;
  return {sphere_map(surface_mesh), ambient_occlusion(surface_mesh, node_normals(surface_mesh), reach)};
}

const TissueLook& TissueLooks::of(const std::shared_ptr<const SurfaceMesh>& surface_mesh) {
  auto found = std::find_if(known_.begin(), known_.end(), [&](const Known& known) {
    return known.surface_mesh == surface_mesh || (known.surface_mesh->rest == surface_mesh->rest &&
                                                  known.surface_mesh->triangles == surface_mesh->triangles);
  });
  if (found == known_.end()) {
    if (known_.size() == max_known) known_.erase(known_.begin());
    known_.push_back({surface_mesh, tissue_look(*surface_mesh)});
  } else {
    std::rotate(found, found + 1, known_.end());
  }
  return known_.back().look;
}

TissueLook tissue_look(const TissueLook& whole, const OriginalSkin& skin) {
  TissueLook look;
  for (const auto& [nodes, weights, depth] : skin.places()) {
    Vec3f direction = Vec3f::Zero();
    float open = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      direction += weights[k] * whole.on_sphere[nodes[k]];
      open += weights[k] * whole.ambient_occlusion[nodes[k]];
    }
    look.on_sphere.push_back(direction.normalized());
    look.ambient_occlusion.push_back(open);
  }
  return look;
}

}  // namespace heml::render
