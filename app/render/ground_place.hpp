#pragma once
// Where the ground lies: under the body at rest and the tables. It stays there when a body falls, and gives way only to
// what hangs: parts of the body with a constrained node, which cannot fall.
#include <app/render/bounds.hpp>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

class GroundPlace {
 public:
  GroundPlace() = default;
  explicit GroundPlace(const SurfaceMesh& surface_mesh);
  /// m, its middle. rest: round the body at rest. The frame is one of the surface mesh.
  Vec3f centre(const Frame& frame, const BoundingSphere& rest) const;

 private:
  std::vector<std::size_t> hanging_;  ///< nodes of the surface, in parts that have a constrained one
};

}  // namespace heml::render
