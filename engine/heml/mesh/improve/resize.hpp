#pragma once
// Coarsens or refines a mesh to a wanted number of elements.
#include <heml/mesh/improve/surface_guard.hpp>

namespace heml {

/// Collapses edges, short ones first, until there are no more than `tets` elements or none can be collapsed within the
/// surface's tolerance without making an element worse than `quality` and than those it had.
void coarsen(LocalMesh& mesh, const SurfaceGuard& guard, int tets, double quality);

/// Splits edges that are the longest of all elements round them, long ones first, until there are at least `tets`.
void refine_longest(LocalMesh& mesh, int tets);

}  // namespace heml
