#pragma once
// The first half of a cut (cut.hpp): elements are split where the surface swept by the blade crosses their edges.
// Pieces still share their nodes; cut.cpp separates them.
#include <heml/mesh/cut.hpp>

namespace heml {

/// An element, or a part of a split one, that has a node in the cut.
struct CutPiece {
  Tet tet;                                       ///< nodes before copies are made
  int parent;                                    ///< element
  std::array<int, 4> neighbour{-1, -1, -1, -1};  ///< piece across each face; −1: none
  std::array<bool, 4> separated{};               ///< separated from that neighbour
  bool is_new = false;                           ///< its parent was split
};

/// The elements round a cut, split.
struct SplitElements {
  std::vector<Vec3> x;                ///< positions of the mesh's nodes and of new ones on crossed edges, m
  std::vector<InsertedNode> nodes;    ///< the new ones
  std::vector<bool> in_cut;           ///< per node
  std::vector<bool> in_cut_by_sweep;  ///< per node: by this sweep, not only by those before
  std::vector<int> side;              ///< per node of the mesh: 1 on the upper side, −1 on the lower, 0 not beside it
  std::vector<CutPiece> pieces;

  const Vec3& at(int n) const { return x[static_cast<std::size_t>(n)]; }
  bool is_in_cut(int n) const { return in_cut[static_cast<std::size_t>(n)]; }
};

/// Splits the elements that a surface crosses; crossings near an end of their edge snap to it. x: #V×3, m, the mesh's
/// nodes as they are. snap, stroke: of make_cut(). Returns nothing if the surface crosses no edge.
std::optional<SplitElements> split_elements(const SweptSurface& surface, const TetMesh& mesh,
                                            const std::vector<Vec3>& x, const Topology& topology, double snap,
                                            const Stroke& stroke);

}  // namespace heml
