#pragma once
// A mesh that is finer where it is wanted: chosen tetrahedra are cut at their longest edge, and with them all that
// share it, so that no node lies within another element's edge (Rivara: Algorithms for refining triangular grids
// suitable for adaptive and multigrid techniques, International Journal for Numerical Methods in Engineering 20, 1984).
//
//    marked edges:  the longest of every chosen element; then the longest of every element that has a marked one, until
//                   there are no more
//    an element:    cut at the longest of its marked edges, its halves at the longest of theirs
//
// Which comes first depends on the lengths and the numbers of the nodes alone, so two elements cut the face between
// them alike.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Refinement {
  TetMesh
      mesh;  ///< old nodes first, in their order, then middles; pieces with the region and fields of what they are of
  std::vector<std::array<int, 2>> ends;  ///< of each middle, the nodes it lies between
  std::vector<int> parents;              ///< #T: the old element each is a piece of, ascending
};

/// Cuts at least the given elements of a mesh that check_tets() has left. Linear functions on the old mesh are linear
/// functions on the new one. Shapes do not degenerate, however often it is done.
Refinement refine_longest_edge(const TetMesh& mesh, const std::vector<int>& chosen);

/// The fewest elements that have this share of a sum, greatest first; of equals the first: what to refine by an
/// estimate of_element (Dörfler's marking). Ascending.
std::vector<int> doerfler_marking(const std::vector<double>& of_element, double share);

}  // namespace heml
