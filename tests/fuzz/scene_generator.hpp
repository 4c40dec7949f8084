#pragma once
// Scenes from seeds, for world_fuzz.cpp. Most are put together from the tables of the engine (laws, keys, commands), so
// that what is added there is generated too; others are shipped scenes, made small. Values of both are then damaged.
#include <cstdint>
#include <filesystem>
#include <string>

namespace heml::fuzz {

/// The text of a scene; the same seed gives the same text. It may name files of write_small_meshes().
std::string scene_of_seed(std::uint64_t seed);

/// Meshes of one to a few elements with what is odd about them (elements that meet in a node, nodes without element, a
/// sliver, regions, fields), and flat and mirrored positions of each.
void write_small_meshes(const std::filesystem::path& folder);

}  // namespace heml::fuzz
