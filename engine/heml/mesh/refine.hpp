#pragma once
// Local refinement by longest-edge bisection: selected tetrahedra are bisected at their longest edge together with all
// elements that share it, so that no hanging nodes result (Rivara: Algorithms for refining triangular grids suitable
// for adaptive and multigrid techniques, International Journal for Numerical Methods in Engineering 20, 1984).
//
//    marked edges:  the longest of every selected element; then the longest of every element with a marked edge, until
//                   nothing changes
//    an element:    is bisected at its longest marked edge, its halves recursively at theirs
//
// The order of edges depends only on their lengths and node numbers, so two elements divide their common face alike.
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

struct Refinement {
  TetMesh mesh;  ///< old nodes in order, then midpoints; elements have their parent's region and fields
  std::vector<std::array<int, 2>> midpoint_edges;  ///< old nodes at the ends of each midpoint's edge
  std::vector<int> parents;                        ///< #T: the old element that each is a part of, ascending
};

/// Bisects at least the chosen elements of a mesh that check_tets() accepts. Piecewise linear functions on the old mesh
/// are piecewise linear on the new one. Shapes do not degenerate under repeated refinement.
Refinement refine_longest_edge(const TetMesh& mesh, const std::vector<int>& chosen);

/// Dörfler marking: the smallest set of elements whose estimates sum to at least `share` of the total, ascending. Of
/// equal estimates, lower numbers first.
std::vector<int> doerfler_marking(const std::vector<double>& of_element, double share);

}  // namespace heml
