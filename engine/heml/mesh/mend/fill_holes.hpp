#pragma once
// Fills holes of a surface with triangles between the nodes of their edges: of all ways to do so, the one of least area
// (G. Barequet & M. Sharir, Filling gaps in the boundary of a polyhedron, Computer Aided Geometric Design 12, 1995).
#include <heml/mesh/tet_mesh.hpp>

namespace heml {

struct FilledHoles {
  int holes = 0, edges = 0;  ///< filled
  int left_open = 0;         ///< that have no filling, or one that would take too long
  double longest = 0;        ///< length round the largest one, m
  double largest_share = 0;  ///< area of its filling, of the surface
  int sheets = 0;            ///< components left out: their openings are nearly as large as they are
  double sheet_area = 0;     ///< of these, share of the whole area; 1: nothing else is there, and nothing was changed
};

/// Requires consistent orientation within components (shells.hpp). Work is bounded: O(n³) for a hole of n edges.
FilledHoles fill_holes(TriangleMesh& surface);

}  // namespace heml
