#pragma once
// Surfaces made for the eye often run through themselves in a few creases, by less than an edge.
#include <heml/mesh/intersections.hpp>

namespace heml {

/// Smooths the crossing triangles and their surroundings until none crosses, and says through warn() how far nodes
/// moved. Only where few triangles are concerned and nodes need to move by less than an edge or so; otherwise the
/// surface is left as it was and false returned.
bool untangle(TriangleMesh& surface, const Intersections& found);

}  // namespace heml
