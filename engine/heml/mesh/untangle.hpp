#pragma once
// Repairs small self-intersections: surfaces made for display often intersect themselves in a few creases, by less than
// an edge length.
#include <heml/mesh/intersections.hpp>

namespace heml {

/// Smooths the intersecting triangles and their neighbourhood until none intersect, and warns how far nodes moved.
/// Returns false and leaves the surface unchanged if more than 2 % of the triangles intersect or a node would move by
/// more than 1.5 mean edge lengths.
bool untangle(TriangleMesh& surface, const Intersections& found);

}  // namespace heml
