#pragma once
// Orientation of a mesh by its topology, so that elements that are turned inside out can be told from such as only list
// their nodes in another order.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Orders the nodes of every element so that neighbours see their common face from opposite sides and the volume of
/// each connected part is positive. Returns the elements that are inverted or flat, ascending. Throws InputError for
/// faces of more than two elements and parts that cannot be oriented or have no boundary. Requires
/// check_connectivity().
std::vector<int> orient_elements(TetMesh& mesh);

}  // namespace heml
