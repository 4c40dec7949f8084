#pragma once
// Procedural texture of fine vessels and bumps over the unit sphere (mapped to a body by sphere_map.hpp), stored as an
// octahedral map: Cigolle et al., "A survey of efficient representations for independent unit vectors", 2014.
#include <cstdint>
#include <vector>

namespace heml::render {

/// side²·4 bytes. rgb: gradient of fine bumps, a vector in the sphere's space (128: 0). a: below 128 the blush round
/// vessels, from 128 on the vessels. Deterministic.
std::vector<std::uint8_t> tissue_texture(int side);

}  // namespace heml::render
