#pragma once
// Removes an edge: the elements round it are replaced by others between the same nodes, by the triangulation of the
// ring with the best worst element (dynamic programming: G. Klincsek, Minimal triangulations of polygonal domains,
// 1980). 3-2 and 4-4 flips are cases. An edge of the surface is flipped with the elements behind it; a flat element
// between two faces of the surface goes.
#include <heml/mesh/improve/surface_guard.hpp>

namespace heml {

/// Returns whether the edge was removed, which raised the worst quality of the elements concerned.
bool remove_edge(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b);

}  // namespace heml
