#pragma once
// The fine skin of an edited body: it is parted along the rims of wounds, each side goes on to hang on the tissue
// behind it, and what lay over removed tissue is gone. Where it lies above the body's surface, a strip closes the gap
// between its new edge and the wound's:
//
//      skin ═════════╗     ╔═══════════
//     body ──────────╢     ╟─────────── ║ the strips
//                    │wound│
#include <heml/mesh/edit.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/scenario/skin.hpp>
#include <heml/session/frame.hpp>

namespace heml {

class SkinCutter {
 public:
  /// skin: of the body before all edits, whose surface `whole` is.
  SkinCutter(std::shared_ptr<const Skin> skin, std::shared_ptr<const SurfaceMesh> whole);

  /// The skin of the body with edits. surface: with `whole`. mesh: with the elements that there are and were. Takes
  /// milliseconds, and more with the length of the wounds.
  std::shared_ptr<const Skin> cut(const SurfaceMesh& surface, const Topology& topology, const TetMesh& mesh) const;

 private:
  class Cut;

  static TriangleMesh as_mesh(const std::vector<Vec3f>& nodes, std::vector<Triangle> triangles);
  void anchor();
  void find_fans();

  std::shared_ptr<const Skin> skin_;
  std::shared_ptr<const SurfaceMesh> whole_;
  SurfaceTree tree_, body_;          ///< of the skin, and of the body's surface
  std::vector<std::uint32_t> same_;  ///< #V: the lowest vertex at the same place
  std::vector<std::size_t> first_;   ///< #V+1, of around_
  std::vector<int> around_;          ///< the triangles round each vertex that is its own `same`
  std::vector<int> faces_;           ///< #V: nearest face of `whole`
  std::vector<SkinAnchor> anchors_;  ///< #V
  double reach_ = 0;                 ///< m, the greatest distance between skin and body's surface
};

}  // namespace heml
