#pragma once
// What a closed surface encloses.
#include <heml/session/frame.hpp>
#include <span>

namespace heml::panel {

/// m³, by the divergence theorem: that of all tetrahedra together, those turned inside out counted negative.
/// positions: #S×3, m, in the order of Skin::nodes.
double enclosed_volume(const Skin& skin, std::span<const Vec3f> positions);
/// At rest.
inline double enclosed_volume(const Skin& skin) { return enclosed_volume(skin, skin.rest); }

}  // namespace heml::panel
