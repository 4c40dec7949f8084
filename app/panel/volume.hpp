#pragma once
// Volume enclosed by a closed surface.
#include <heml/session/frame.hpp>
#include <span>

namespace heml::panel {

/// m³, by the divergence theorem: the sum over all tetrahedra, inverted ones counted negative. 0 if the sizes differ.
/// positions: #S×3, m, in the order of SurfaceMesh::nodes.
double enclosed_volume(const SurfaceMesh& surface_mesh, std::span<const Vec3f> positions);
/// At rest.
inline double enclosed_volume(const SurfaceMesh& surface_mesh) {
  return enclosed_volume(surface_mesh, surface_mesh.rest);
}

}  // namespace heml::panel
