#pragma once
// Merging nodes of a surface.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// For each node, the first of the nodes that have exactly its position.
std::vector<int> equal_nodes(const TriangleMesh& surface);

/// Gives every triangle the nodes same[node] instead of its own; drops triangles that have a node twice then, and nodes
/// without a triangle. Nodes are in the order of their first use.
TriangleMesh merge_nodes(const TriangleMesh& surface, const std::vector<int>& same);

}  // namespace heml
