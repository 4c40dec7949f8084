#pragma once
// Writes tetrahedral meshes; the file name's ending selects the format.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Writes .msh (Gmsh 2.2), .mesh (Medit), .vtk (legacy ASCII), .vtu (ASCII), or .node (and .ele) with 17 significant
/// digits and regions. Only .msh, .vtk and .vtu keep fields; the others warn if there are any. Names of regions are
/// kept by .msh alone. Throws InputError for another ending or if the file cannot be written.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh);

/// Whether write_tet_mesh() writes this ending.
bool is_written_mesh_file(const std::filesystem::path& path);

}  // namespace heml
