#pragma once
// Merges a node into a neighbour. The topology stays that of the input (link condition: T. Dey, H. Edelsbrunner, S.
// Guha & D. Nekhayev, Topology preserving edge contraction, 1999).
#include <heml/mesh/improve/surface_guard.hpp>

namespace heml {

/// Merges node a into b if all elements of a then have at least the given quality. Nodes of the surface go along the
/// surface, those of a crease along it, corners stay. Returns whether it was done.
bool collapse_edge(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b, double quality);

/// The same, if it raises the worst quality of the elements of a.
bool collapse_if_better(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b);

}  // namespace heml
