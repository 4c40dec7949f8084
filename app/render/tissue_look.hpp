#pragma once
// Appearance data that depend only on the rest shape and are slow to compute. After an edit of the mesh they are
// interpolated from those of the original skin: the pattern does not move.
#include <heml/session/frame.hpp>
#include <heml/session/original_skin.hpp>
#include <memory>
#include <vector>

namespace heml::render {

struct TissueLook {
  std::vector<Vec3f> on_sphere;          ///< #S×3, sphere_map.hpp
  std::vector<float> ambient_occlusion;  ///< #S, ambient_occlusion.hpp
};

/// The look of a surface without edits.
TissueLook tissue_look(const SurfaceMesh& surface_mesh);

/// Looks of the surfaces without edits that were asked for last, since a viewer may go back and forth between bodies.
class TissueLooks {
 public:
  /// Of this surface, or of an equal one. Valid until the next call.
  const TissueLook& of(const std::shared_ptr<const SurfaceMesh>& surface_mesh);

 private:
  struct Known {
    std::shared_ptr<const SurfaceMesh> surface_mesh;
    TissueLook look;
  };
  std::vector<Known> known_;  ///< the last one asked for at the end
};

/// The look of an edited surface. whole: of the surface before all edits. skin: of the edited one.
TissueLook tissue_look(const TissueLook& whole, const OriginalSkin& skin);

}  // namespace heml::render
