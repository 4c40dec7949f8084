#pragma once
// Tearing: the elements round a node separate along the faces nearest to a plane through it. The volume is kept and no
// node moves.
//
//      ╱╲ ╱╲          ╱╲ ╱╲       the node is copied for each further group of elements connected on one side of
//     ╱__o__╲   ──►  ╱__o__╲      the plane; faces between groups separate at this node and stay connected at their
//     ╲  ╱╲  ╱         o  o       other nodes, from which the tear may propagate
//      ╲╱  ╲╱         ╲╱  ╲╱
#include <heml/mesh/edit.hpp>
#include <span>

namespace heml {

/// A node at which the mesh tears, and the normal of the tear plane at rest.
struct TearOpening {
  int node;
  Vec3 plane_normal;
};

struct Tear {
  MeshEdit edit;
  std::size_t faces = 0;  ///< number of separated faces
  double area = 0;        ///< m², their deformed area
};

/// The existing elements round each node.
class NodeToElements {
 public:
  NodeToElements() = default;
  NodeToElements(const TetMesh& mesh, const Topology& topology);
  std::span<const int> of(int node) const {
    const auto n = static_cast<std::size_t>(node);
    return std::span(list_).subspan(start_[n], start_[n + 1] - start_[n]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<int> list_;
};

/// Whether a node has elements on both sides of the tear plane.
bool can_tear(const TearOpening& opening, const TetMesh& mesh, const NodeToElements& around);

/// Computes the edit that tears the mesh at the given nodes, no two of which may share an element. mesh: at rest. x:
/// deformed positions, #V×3, m.
Tear make_tear(const std::vector<TearOpening>& openings, const TetMesh& mesh, const std::vector<Vec3>& x,
               const NodeToElements& around);

}  // namespace heml
