#pragma once
// Reads tetrahedral meshes; the file name's ending selects the format.
#include <filesystem>
#include <heml/mesh/quadratic.hpp>

namespace heml {

/// Reads Gmsh .msh (1.0, 2.2, 4.1; ASCII and binary), Medit .mesh, legacy .vtk (ASCII and binary), .vtu (ASCII, binary
/// and appended, plain or compressed by zlib), Abaqus and CalculiX .inp, FEBio .feb, and TetGen .node/.ele (either
/// name). Regions get the names of .msh's physical groups, .inp's element sets and .feb's parts. Bricks, wedges and
/// pyramids are divided into tetrahedra by their corners (split_cell.hpp), with a warning, as of volume cells that are
/// left out. Indices become 0-based without gaps; nodes keep the file's order. Ten-node tetrahedra (Gmsh, VTK, Abaqus)
/// give `midedges` where all are of ten nodes and it is not null; else their corners are taken, and nodes in the middle
/// of edges alone are left out, with a warning. Scalars and vectors of elements (VTK cell arrays, Gmsh $ElementData,
/// TetGen's attributes after the first) become fields.
/// Throws InputError naming file and line. Does not call check_tets().
TetMesh read_tet_mesh(const std::filesystem::path& path, MidEdges* midedges = nullptr);

/// Whether read_tet_mesh() reads this ending. (It rejects .msh and .mesh files that hold only surfaces.)
bool is_tet_mesh_file(const std::filesystem::path& path);

}  // namespace heml
