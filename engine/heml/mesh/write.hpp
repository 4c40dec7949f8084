#pragma once
// Meshes to files, by ending.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// .msh (Gmsh 2.2), .mesh (Medit), .vtk (legacy ASCII), .vtu (ASCII), .node (+ .ele beside it); 17 significant digits,
/// regions kept; fields kept by .msh, .vtk and .vtu, a warning tells where they are not. Throws InputError when the
/// ending is another or the file cannot be written.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);

}  // namespace heml
