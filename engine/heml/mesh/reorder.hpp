#pragma once
// Renumbers nodes and elements for memory locality: neighbours in space are close in memory.
#include <heml/mesh/quadratic.hpp>
#include <vector>

namespace heml {

/// Permutations: new_node[i] is the internal number of the file's node i; file_node is the inverse. Likewise for
/// tetrahedra.
struct Reordering {
  std::vector<int> new_node, file_node;  ///< #V
  std::vector<int> new_tet, file_tet;    ///< #T
};

/// Order of tetrahedra (by centroid) and nodes along a Hilbert curve; orphan nodes last. Deterministic.
Reordering hilbert_order(const TetMesh& mesh, const MidEdges& midedges = {});

/// The mesh in internal order, fields included.
TetMesh reordered(const TetMesh& mesh, const Reordering& order);
/// The mid-edge nodes in internal order.
MidEdges reordered(const MidEdges& midedges, const Reordering& order);

}  // namespace heml
