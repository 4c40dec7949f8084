#pragma once
// The same body on a finer mesh, or of quadratic elements.
#include <heml/world/setup.hpp>

namespace heml {

/// mesh: the setup's nodes first, in their order, then midpoints of edges. midpoint_edges: the two nodes of the edge of
/// each midpoint. A selection that contains both nodes of an edge also gets its midpoint; the initial position of a
/// midpoint is the mean of the two.
WorldSetup on_finer_mesh(WorldSetup setup, TetMesh mesh, const std::vector<std::array<int, 2>>& midpoint_edges);

/// A node in the middle of each edge, after all others (mesh/quadratic.hpp); lists and positions as above.
WorldSetup with_midedges(WorldSetup setup);

/// Whether the elements are linear, or quadratic with the middles that with_midedges() makes.
bool has_straight_edges(const WorldSetup& setup);

/// The setup without the middles of edges, for has_straight_edges(): with_midedges() makes them again, in lists where
/// these hold both ends.
WorldSetup corners_of(WorldSetup setup);

}  // namespace heml
