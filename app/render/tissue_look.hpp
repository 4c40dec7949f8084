#pragma once
// Appearance data that depend only on the rest shape and are slow to compute. After a removal, nodes with unchanged
// surroundings keep their values: the pattern does not move, and few nodes are recomputed.
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

struct TissueLook {
  std::vector<Vec3f> on_sphere;          ///< #S×3, sphere_map.hpp
  std::vector<float> ambient_occlusion;  ///< #S, ambient_occlusion.hpp
};

/// whole: the look of surface_mesh.whole; null if and only if that is null.
TissueLook tissue_look(const SurfaceMesh& surface_mesh, const TissueLook* whole);

}  // namespace heml::render
