#pragma once
// Points that move with a mesh of tetrahedra: each is an affine combination of the corners of one, so that it turns,
// stretches and bends with it. A point outside of the body hangs on the tetrahedron behind the nearest point of the
// surface, with weights below 0, by which it keeps its distance as that one moves.
//
//        ·   outside: weights of the tetrahedron behind, one below 0
//     ───┬──────── surface
//       / \   ·   inside: weights between 0 and 1, of 1 in all
#include <heml/mesh/tet_mesh.hpp>
#include <span>
#include <vector>

namespace heml {

struct Embedding {
  std::vector<int> tets;                      ///< #P: which tetrahedron of the mesh
  std::vector<Tet> nodes;                     ///< #P: its corners
  std::vector<std::array<float, 4>> weights;  ///< #P: of 1 in all
  double farthest = 0;                        ///< m: of a point from the body

  std::size_t size() const { return nodes.size(); }
  /// A value of point p from those of the mesh's nodes.
  template <class Value>
  Value at(std::size_t p, std::span<const Value> of_nodes) const {
    const Tet& n = nodes[p];
    const std::array<float, 4>& w = weights[p];
    return w[0] * of_nodes[static_cast<std::size_t>(n[0])] + w[1] * of_nodes[static_cast<std::size_t>(n[1])] +
           w[2] * of_nodes[static_cast<std::size_t>(n[2])] + w[3] * of_nodes[static_cast<std::size_t>(n[3])];
  }
};

/// Embeds points (m) in a mesh at rest, which must have tetrahedra, all of positive volume. Takes all cores; the same
/// on any number of them.
Embedding embed(std::span<const Vec3> points, const TetMesh& mesh);

}  // namespace heml
