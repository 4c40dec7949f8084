#pragma once
// Positions of nodes as CSV: header `node,x,y,z`, one node a line, metres.
#include <filesystem>
#include <heml/math/types.hpp>
#include <vector>

namespace heml {

/// #V×3, m. Every node from 0 to nodes − 1 must occur once, in any order. Throws InputError naming the line.
std::vector<Vec3> read_positions_csv(const std::filesystem::path& path, int nodes);

/// Writes 17 significant digits. Throws InputError when the file cannot be written.
void write_positions_csv(const std::filesystem::path& path, const std::vector<Vec3>& positions);

}  // namespace heml
