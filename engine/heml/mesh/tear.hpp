#pragma once
// Tearing: elements round a node come apart along their faces, on both sides of a plane through it. Nothing is lost and
// nothing moves.
//
//      ╱╲ ╱╲          ╱╲ ╱╲       the node has a copy for each further group of its elements that hang together
//     ╱__o__╲   ──►  ╱__o__╲      on one side; faces between groups come apart at it, and hang together still at
//     ╲  ╱╲  ╱         o  o       their other nodes, where the tear may go on
//      ╲╱  ╲╱         ╲╱  ╲╱
#include <heml/mesh/edit.hpp>
#include <span>

namespace heml {

/// A node to open, and the normal of the plane at rest.
struct TearOpening {
  int node;
  Vec3 plane_normal;
};

struct Tear {
  MeshEdit edit;
  std::size_t faces = 0;  ///< that come apart
  double area = 0;        ///< m², of them, as the body is now
};

/// The elements that are there round each node.
class NodeToElements {
 public:
  NodeToElements(const TetMesh& mesh, const Topology& topology);
  std::span<const int> of(int node) const {
    const auto n = static_cast<std::size_t>(node);
    return std::span(list_).subspan(start_[n], start_[n + 1] - start_[n]);
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<int> list_;
};

/// Whether a node has elements on both sides of the plane.
bool can_open(const TearOpening& opening, const TetMesh& mesh, const NodeToElements& around);

/// Opens nodes that share no element. mesh: at rest. x: its nodes now, #V×3, m.
Tear make_tear(const std::vector<TearOpening>& openings, const TetMesh& mesh, const std::vector<Vec3>& x,
               const NodeToElements& around);

}  // namespace heml
