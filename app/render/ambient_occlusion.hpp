#pragma once
// Ambient occlusion of the surface nodes at rest. Computed once per surface mesh.
#include <heml/session/frame.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml::render {

/// #S values from 0 (occluded) to 1 (open): the fraction of rays, cosine-weighted about the node's normal, that hit
/// nothing within `reach` (m). normals: #S×3, unit. known: #S values to keep where set, or empty. Deterministic; takes
/// about a second for 50,000 nodes without a known value.
std::vector<float> ambient_occlusion(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& normals, float reach,
                                     std::span<const std::optional<float>> known = {});

}  // namespace heml::render
