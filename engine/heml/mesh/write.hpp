#pragma once
// Writes tetrahedral meshes; the file name's ending selects the format.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>
#include <map>

namespace heml {

/// Writes .msh (Gmsh 2.2), .mesh (Medit), .vtk (legacy ASCII), .vtu (ASCII), or .node (and .ele) with 17 significant
/// digits and regions. Only .msh, .vtk and .vtu keep fields; the others warn if there are any. region_names: kept by
/// .msh alone. Throws InputError for another ending or if the file cannot be written.
void write_tet_mesh(const std::filesystem::path& path, const TetMesh& mesh,
                    const std::map<int, std::string>& region_names = {});

}  // namespace heml
