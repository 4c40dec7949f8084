#pragma once
// How much of the sky each surface node sees at rest: what makes hollows dark. Computed once for a skin.
#include <heml/session/frame.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml::render {

/// #S values from 0 (buried) to 1 (open): the share of rays, cosine-weighted about the node's normal, that meet nothing
/// within `reach` (m). normals: #S×3, unit. known: #S, values that are kept where there is one, or empty. The same for
/// the same skin; about a second for 50,000 nodes that are not known.
std::vector<float> ambient_occlusion(const SurfaceMesh& surface_mesh, const std::vector<Vec3f>& normals, float reach,
                                     std::span<const std::optional<float>> known = {});

}  // namespace heml::render
