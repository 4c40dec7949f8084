#pragma once
// What tissue looks like from near: fine vessels and bumps over the unit sphere (sphere_map.hpp lays it on a body). An
// octahedral map wraps the sphere into a square: Cigolle et al., "A survey of efficient representations for independent
// unit vectors", 2014.
#include <cstdint>
#include <vector>

namespace heml::render {

/// side²·4 bytes. Three: the slope of fine bumps, a vector in the space of directions (128: 0). The fourth: below 128
/// the blush beside vessels, from there on the vessels themselves. The same every time.
std::vector<std::uint8_t> tissue_texture(int side);

}  // namespace heml::render
