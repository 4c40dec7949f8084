#pragma once
// Splits an edge, and all elements round it, at its midpoint.
#include <heml/mesh/improve/surface_guard.hpp>

namespace heml {

/// Returns the new node. The edge must exist.
int split_edge(LocalMesh& mesh, int a, int b);

/// Splits the edge and moves the new node to its best place. Returns false and leaves the mesh as it was if the worst
/// quality round the edge is not raised by that.
bool split_if_better(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b);

}  // namespace heml
