#pragma once
// Moves a node to where the worst of its elements is best (L. Freitag & C. Ollivier-Gooch, Tetrahedral mesh improvement
// using swapping and smoothing, International Journal for Numerical Methods in Engineering 40, 1997).
#include <heml/mesh/improve/surface_guard.hpp>

namespace heml {

/// Returns whether the worst quality round the node was raised. A node on a smooth part of the surface stays on the
/// original surface, one on a crease moves along it.
bool smooth_node(LocalMesh& mesh, const SurfaceGuard& guard, int node);

}  // namespace heml
