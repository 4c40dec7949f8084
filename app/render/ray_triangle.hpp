#pragma once
// Ray–triangle intersection: Möller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
#include <heml/math/types.hpp>
#include <limits>

namespace heml::render {

/// Distance along a ray to a triangle, from either side; infinity if it misses or an input is not finite.
inline float ray_meets(const Vec3f& origin, const Vec3f& direction, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  constexpr float miss = std::numeric_limits<float>::infinity();
  const Vec3f e1 = b - a, e2 = c - a;
  const Vec3f p = direction.cross(e2);
  const float determinant = e1.dot(p);
  if (determinant == 0) return miss;
  const Vec3f s = origin - a;
  const float u = s.dot(p) / determinant;
  if (!(u >= 0 && u <= 1)) return miss;
  const Vec3f q = s.cross(e1);
  const float v = direction.dot(q) / determinant;
  if (!(v >= 0 && u + v <= 1)) return miss;
  const float t = e2.dot(q) / determinant;
  return t > 0 ? t : miss;
}

}  // namespace heml::render
