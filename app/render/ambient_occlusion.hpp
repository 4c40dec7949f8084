#pragma once
// Ambient occlusion of the surface nodes at rest. Computed once per surface mesh.
#include <heml/session/frame.hpp>
#include <span>
#include <vector>

namespace heml::render {

/// #S values from 0 (occluded) to 1 (open): the fraction of rays, cosine-weighted about the node's normal, that hit
/// nothing within `reach` (m). normals: #S×3, unit. Deterministic; takes about a second for 50,000 nodes.
std::vector<float> ambient_occlusion(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& normals, float reach);

}  // namespace heml::render
