#pragma once
// The plane that cuts the drawn body open.
#include <heml/math/types.hpp>

namespace heml::render {

struct SectionPlane {
  Vec3f normal = Vec3f::UnitX();  ///< unit, towards what is left out
  float offset = 0;               ///< m, of the plane from the origin along the normal

  /// m, distance of a point from the plane; above 0: left out of the picture.
  float beyond(const Vec3f& point) const { return normal.dot(point) - offset; }
};

}  // namespace heml::render
