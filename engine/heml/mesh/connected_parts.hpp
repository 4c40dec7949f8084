#pragma once
#include <heml/mesh/quadratic.hpp>
#include <vector>

namespace heml {

/// Parts of a mesh that share no node: of each node, one that stands for its part; a node of no element stands for
/// itself. midedges: of quadratic elements, else empty.
std::vector<int> connected_parts(const TetMesh& mesh, const MidEdges& midedges);

}  // namespace heml
