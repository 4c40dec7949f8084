#pragma once
// How much of the sky each surface node sees at rest: what makes hollows dark. Computed once for a skin.
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

/// #S values from 0 (buried) to 1 (open): the share of rays, cosine-weighted about the node's normal, that meet nothing
/// within `reach` (m). normals: #S×3, unit. The same for the same skin; about a second for 50,000 nodes.
std::vector<float> ambient_occlusion(const Skin& skin, const std::vector<Vec3f>& normals, float reach);

}  // namespace heml::render
