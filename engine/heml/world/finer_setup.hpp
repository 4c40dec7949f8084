#pragma once
// The same body on a finer mesh.
#include <heml/world/setup.hpp>

namespace heml {

/// mesh: the setup's nodes first, in their order, then midpoints of edges. midpoint_edges: the two nodes of the edge of
/// each midpoint. A selection that contains both nodes of an edge also gets its midpoint; the initial position of a
/// midpoint is the mean of the two.
WorldSetup on_finer_mesh(WorldSetup setup, TetMesh mesh, const std::vector<std::array<int, 2>>& midpoint_edges);

}  // namespace heml
