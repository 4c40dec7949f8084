#pragma once
// What of a skin's look depends on its rest shape alone, and takes long to find. Of a body that lost a part, nodes
// whose surroundings are those of the whole body look as they did there: the pattern does not swim, and little is to be
// done.
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

struct TissueLook {
  std::vector<Vec3f> on_sphere;  ///< #S×3, sphere_map.hpp
  std::vector<float> openness;   ///< #S, ambient_occlusion.hpp
};

/// whole: the look of skin.whole, where the skin has one.
TissueLook tissue_look(const SurfaceMesh& surface_mesh, const TissueLook* whole);

}  // namespace heml::render
