#pragma once
// The plane that cuts the drawn body open.
#include <array>
#include <heml/math/types.hpp>
#include <optional>

namespace heml::render {

struct SectionPlane {
  Vec3f normal = Vec3f::UnitX();  ///< unit, towards what is left out
  float offset = 0;               ///< m, of the plane from the origin along the normal

  /// m, distance of a point from the plane; above 0: left out of the picture.
  float beyond(const Vec3f& point) const { return normal.dot(point) - offset; }
};

/// Whether a plane, if there is one, leaves a point out of the picture.
inline bool is_left_out(const std::optional<SectionPlane>& plane, const Vec3f& point) {
  return plane && plane->beyond(point) > 0;
}

/// The part of a segment that a plane, if there is one, leaves in the picture; none: it leaves out all of it.
inline std::optional<std::array<Vec3f, 2>> part_left_in(const std::optional<SectionPlane>& plane, const Vec3f& from,
                                                        const Vec3f& to) {
  const bool from_out = is_left_out(plane, from), to_out = is_left_out(plane, to);
  if (from_out && to_out) return std::nullopt;
  if (!from_out && !to_out) return std::array{from, to};
  const float a = plane->beyond(from), b = plane->beyond(to);
  const Vec3f crossing = from + a / (a - b) * (to - from);
  return from_out ? std::array{crossing, to} : std::array{from, crossing};
}

}  // namespace heml::render
