#pragma once
// Surfaces to files, by ending.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <heml/mesh/write_vtu.hpp>

namespace heml {

/// .ply (ASCII, with scalar fields of nodes as properties) or .obj (fields left out); 17 significant digits. Throws
/// InputError when the ending is another or the file cannot be written.
void write_surface(const std::filesystem::path& path, const TriangleMesh& surface,
                   const std::vector<NodeField>& fields = {});

}  // namespace heml
