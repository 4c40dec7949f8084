#pragma once
// What a closed surface encloses.
#include <heml/session/frame.hpp>
#include <span>

namespace heml::panel {

/// m³, by the divergence theorem: that of all tetrahedra together, those turned inside out counted negative.
/// positions: #S×3, m, in the order of Skin::nodes.
double enclosed_volume(const SurfaceMesh& surface_mesh, std::span<const Vec3f> positions);
/// At rest.
inline double enclosed_volume(const SurfaceMesh& surface_mesh) {
  return enclosed_volume(surface_mesh, surface_mesh.rest);
}

}  // namespace heml::panel
