#pragma once
// Closest points on triangles and segments, and where a segment passes through a triangle.
#include <algorithm>
#include <heml/math/types.hpp>
#include <optional>
#include <utility>

namespace heml {

/// Barycentric weights of the point of triangle abc closest to p (C. Ericson, Real-Time Collision Detection, 2005,
/// 5.1.5).
inline std::array<double, 3> closest_point_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

/// Parameters s, t in [0, 1] of the closest points of two segments, p + s u and q + t v (Ericson 2005, 5.1.9). Segments
/// may be points.
inline std::pair<double, double> closest_on_segments(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
  const Vec3 r = p - q;
  const double a = u.squaredNorm(), e = v.squaredNorm(), f = v.dot(r), c = u.dot(r), b = u.dot(v);
  if (!(e > 0)) return {a > 0 ? std::clamp(-c / a, 0.0, 1.0) : 0, 0};
  if (!(a > 0)) return {0, std::clamp(f / e, 0.0, 1.0)};
  const double determinant = a * e - b * b;
  double s = determinant > 1e-12 * a * e ? std::clamp((b * f - c * e) / determinant, 0.0, 1.0) : 0;
  double t = (b * s + f) / e;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((b * t - c) / a, 0.0, 1.0);
  }
  return {s, t};
}

/// Six times the signed volume of tetrahedron a, b, p, q. Computed for one fixed direction of the edge pq, so that the
/// two triangles at that edge get exactly opposite values.
inline double side_of_edge(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  const bool in_order = std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
  const Vec3& first = in_order ? p : q;
  const Vec3& second = in_order ? q : p;
  const double volume = (b - a).cross(first - a).dot(second - a);
  return in_order ? volume : -volume;
}

/// Where segment ab passes through a triangle, 0 at a, 1 at b: as by Möller & Trumbore (1997), with the signs above.
/// None for a segment in the triangle's plane.
inline std::optional<double> segment_triangle_crossing(const Vec3& a, const Vec3& b, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double from = normal.dot(a - t[0]), to = normal.dot(b - t[0]);
  if ((from > 0) == (to > 0) || from == to) return std::nullopt;
  const double s0 = side_of_edge(a, b, t[0], t[1]), s1 = side_of_edge(a, b, t[1], t[2]),
               s2 = side_of_edge(a, b, t[2], t[0]);
  if (!((s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0))) return std::nullopt;
  return std::clamp(from / (from - to), 0.0, 1.0);
}

}  // namespace heml
