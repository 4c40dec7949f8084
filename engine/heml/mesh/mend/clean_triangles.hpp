#pragma once
// Local repairs of nodes and triangles. Each returns how many it made.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

/// Merges nodes nearer than a distance (m) to each other.
int weld_nodes(TriangleMesh& surface, double distance);

/// Merges nodes of open edges that lie nearer to each other than a tenth of the shortest of their open edges.
int weld_cracks(TriangleMesh& surface);

/// Removes triangles without area; the open edges that this leaves are split_at_nodes()'s.
int remove_flat_triangles(TriangleMesh& surface);

/// Leaves one of the triangles of the same three nodes.
int remove_duplicate_triangles(TriangleMesh& surface);

/// Splits triangles at nodes of other open edges that lie on an open edge of theirs (T-junctions).
int split_at_nodes(TriangleMesh& surface);

}  // namespace heml
