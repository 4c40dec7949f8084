#pragma once
// Where the original surface of an edited body ends: the lips of its cuts, and the edges of what was torn out.
#include <heml/session/frame.hpp>

namespace heml {

struct WoundRim {
  /// Nodes at one place at rest are one here, so that both lips of a cut are one line.
  struct Node {
    Vec3 place;   ///< m, at rest
    Vec3 normal;  ///< unit, of the original faces round it
  };
  struct Edge {
    std::array<int, 2> nodes;  ///< ascending
    std::array<int, 2> faces;  ///< of the surface: the original one that has the edge in this direction, and that which
                               ///< has it in the other; −1: none
  };
  std::vector<Node> nodes;
  std::vector<Edge> edges;  ///< each once
};

/// exposed: #F, OriginalSkin::exposed().
WoundRim wound_rim(const SurfaceMesh& surface, const std::vector<char>& exposed);

}  // namespace heml
