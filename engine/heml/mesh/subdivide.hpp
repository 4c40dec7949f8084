#pragma once
// Uniform refinement: divides every tetrahedron into eight at the midpoints of its edges.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Subdivision {
  TetMesh mesh;  ///< old nodes in order, then midpoints; element t becomes 8t to 8t+7 with the same region and fields
  std::vector<std::array<int, 2>> midpoint_edges;  ///< old nodes at the ends of each midpoint's edge
};

/// mesh: as check_tets() leaves it. Piecewise linear functions on the old mesh are piecewise linear on the new one. The
/// octahedron between the four corner tetrahedra is cut along its shortest diagonal, so shapes do not degenerate under
/// repeated subdivision. (Bey: Tetrahedral grid refinement, Computing 55, 1995, chooses the diagonal for at most three
/// shapes instead.)
Subdivision subdivide_uniformly(const TetMesh& mesh);

/// Appends the eight parts of a tetrahedron to the mesh, whose nodes are there. middle: in the order of tet_edges.
void add_subdivision(const Tet& tet, const std::array<int, 6>& middle, TetMesh& mesh);

}  // namespace heml
