#pragma once
// Appearance data that depend only on the rest shape and are slow to compute. After an edit of the mesh they are
// interpolated from those of the original skin: the pattern does not move.
#include <app/render/original_skin.hpp>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

struct TissueLook {
  std::vector<Vec3f> on_sphere;          ///< #S×3, sphere_map.hpp
  std::vector<float> ambient_occlusion;  ///< #S, ambient_occlusion.hpp
};

/// The look of a surface without edits.
TissueLook tissue_look(const SurfaceMesh& surface_mesh);

/// The look of an edited surface. whole: of the surface before all edits. skin: of the edited one.
TissueLook tissue_look(const TissueLook& whole, const OriginalSkin& skin);

}  // namespace heml::render
