#pragma once
// Solid angles of triangles.
#include <cmath>
#include <heml/math/types.hpp>

namespace heml {

/// The solid angle that triangle abc fills seen from the origin, positive when it turns its back: A. van Oosterom,
/// J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983), equation 8.
inline double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.cross(b).dot(c), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace heml
