#pragma once
// Writes surfaces; the file name's ending selects the format.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <heml/mesh/write_vtu.hpp>

namespace heml {

/// Writes .ply (ASCII, scalar fields of nodes as properties) or .obj (without fields) with 17 significant digits.
/// Throws InputError for another ending or if the file cannot be written.
void write_surface(const std::filesystem::path& path, const TriangleMesh& surface,
                   const std::vector<NodeField>& fields = {});

}  // namespace heml
