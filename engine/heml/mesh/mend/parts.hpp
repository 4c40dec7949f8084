#pragma once
// Parts of a damaged surface that do not belong to the body: loose crumbs, inner walls and fins.
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

struct RemovedParts {
  int parts = 0, triangles = 0;
  double largest_share = 0;  ///< area of the largest, of the largest part that stays
};

/// Removes the components (of triangles that share edges) that have less than 0.2 % of the largest one's area.
RemovedParts remove_crumbs(TriangleMesh& surface);

/// Removes parts that end where more than two triangles share an edge: those that no ray from outside reaches (walls
/// between two rooms), and those with open edges too (fins).
RemovedParts remove_walls(TriangleMesh& surface);

/// Orients each component so that the side from which more rays reach infinity is the outside; one that no ray
/// leaves becomes the wall of a cavity. Requires consistent orientation within components (shells.hpp).
void orient_by_sky(TriangleMesh& surface);

}  // namespace heml
