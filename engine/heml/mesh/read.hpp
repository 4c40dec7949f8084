#pragma once
// Meshes from files, by ending.
#include <filesystem>
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Tetrahedra: Gmsh .msh (1.0, 2.2, 4.1 ASCII), Medit .mesh, legacy .vtk (ASCII and binary), .vtu (ASCII), TetGen
/// .node/.ele (either name). Only tetrahedra are kept; indices become 0-based; nodes keep the file's order, gaps in
/// numbering closed. Numbers and vectors of elements (VTK cell arrays, Gmsh $ElementData, TetGen's attributes after the
/// first) become fields. Throws InputError naming file and line. The mesh is as the file has it: see check_tets().
TetMesh read_tet_mesh(const std::filesystem::path& path);

/// Whether the ending is one read_tet_mesh() knows. (.msh and .mesh of surfaces alone are refused there by count.)
bool is_tet_mesh_file(const std::filesystem::path& path);

}  // namespace heml
