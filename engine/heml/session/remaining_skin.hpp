#pragma once
// The faces ("tiles") of the original skin that an edited body still has.
#include <heml/session/original_skin.hpp>

namespace heml {

class RemainingSkin {
 public:
  /// original: of that surface. Both must outlive this.
  RemainingSkin(const SurfaceMesh& surface, const OriginalSkin& original);

  /// The tile at a point of the original skin; −1: the tissue there is gone.
  int at(const Vec3& x) const { return tree_.nearest(x, tolerance_).triangle; }
  /// The surface's face that a tile is, and the tile of a face; −1 for an exposed face and for −1.
  std::size_t face(int tile) const { return static_cast<std::size_t>(faces_[static_cast<std::size_t>(tile)]); }
  int tile_of(int face) const { return face < 0 ? -1 : tiles_[static_cast<std::size_t>(face)]; }
  std::array<Vec3, 3> corners(int tile) const { return tree_.corners(tile); }

  /// Whether a short way over neighbours leads from one tile to another. The sides of a cut share no nodes but at its
  /// ends.
  bool are_connected(int from, int to) const;

  /// #F of the surface before the edits: the tile that a face is; −1: it has been divided, or is gone.
  std::vector<int> kept_of(const SurfaceMesh& whole) const;

 private:
  TriangleMesh list(const OriginalSkin& original);

  const SurfaceMesh& surface_;
  std::vector<int> faces_;            // by tile
  std::vector<int> tiles_;            // by face
  std::vector<std::vector<int>> at_;  // tiles by node of the surface
  SurfaceTree tree_;
  double tolerance_;
};

}  // namespace heml
