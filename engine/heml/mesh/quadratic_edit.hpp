#pragma once
// Edits of quadratic tetrahedra. An edit is made of their corners, as if they were linear; this completes it by the
// nodes in the middle of edges.
//
//     a ──────m────── b        an element's edge, crossed at c: its middle m belongs to no element any longer; the
//     a ──•── c ──•── b        pieces have new middles •
//
// On a part of an element with straight sides in barycentric coordinates, a quadratic field is quadratic. Corners and
// middles of pieces are placed where the shape functions of their element take them, so pieces have its field exactly.
#include <heml/mesh/edit.hpp>

namespace heml {

/// Completes an edit of the corners of quadratic elements, whose new corners are on their edges: new corners get the
/// nodes that they follow, new elements their mid-edge nodes. Middles of edges between old corners stay; those at a copy of a
/// corner are copies; all others are numbered after the new corners, by ascending (smaller, larger) end node.
void add_midedge_nodes(const TetMesh& mesh, const MidEdges& midedges, MeshEdit& edit);

/// Number of integration points of an edit's new elements without positive volume at rest: none where the edges of the
/// mesh are straight.
int count_inverted_points(const TetMesh& mesh, const MeshEdit& edit);

}  // namespace heml
