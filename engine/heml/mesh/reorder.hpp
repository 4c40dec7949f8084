#pragma once
// Locality: nodes and elements renumbered so that what is close in space is close in memory.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// new_node[i] is the inner number of the file's node i; file_node is its inverse. Likewise for tetrahedra.
struct Reordering {
  std::vector<int> new_node, file_node;  ///< #V
  std::vector<int> new_tet, file_tet;    ///< #T
};

/// Hilbert order of tetrahedra (by centroid) and of nodes; orphan nodes last. Depends on the mesh alone.
Reordering hilbert_order(const TetMesh& mesh);

/// The mesh in inner order, its fields too.
TetMesh reordered(const TetMesh& mesh, const Reordering& order);

}  // namespace heml
