#pragma once
// Area and volume of a piece of the body: all that hangs together by nodes.
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::panel {

struct PieceSize {
  double area = 0;    ///< m², of its shown surface
  double volume = 0;  ///< m³, of its shown elements, quadratic ones between their corners
};

/// Finds pieces once for each mesh and measures them in every frame.
class Piece {
 public:
  /// Of the piece with a node (mesh-file number). None: the frame has no solid, or its piece no element.
  std::optional<PieceSize> size_of(int node, const Frame& frame);

 private:
  void find(const Frame& frame);
  int root(int node);

  std::shared_ptr<const Solid> solid_;              // that roots_ are of
  std::shared_ptr<const SurfaceMesh> surface_mesh_;  // likewise
  std::vector<int> roots_;                          // by node: union-find
};

}  // namespace heml::panel
