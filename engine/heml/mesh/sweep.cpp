#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/sweep.hpp>
#include <limits>

namespace heml {
namespace {

/// Closest point of a triangle to p (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3 nearest_point(const Vec3& p, const std::array<Vec3, 3>& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0], bp = p - t[1], cp = p - t[2];
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return t[0];
  if (d3 >= 0 && d4 <= d3) return t[1];
  if (d6 >= 0 && d5 <= d6) return t[2];
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return t[0] + d1 / (d1 - d3) * ab;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return t[0] + d2 / (d2 - d6) * ac;
  if (va <= 0 && d4 >= d3 && d5 >= d6) return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
  return t[0] + (vb * ab + vc * ac) / (va + vb + vc);
}

}  // namespace

SweptSurface::SweptSurface(const Sweep& sweep) {
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    if ((b - a).cross(c - a).norm() <= 1e-12 * longest) return;
    triangles_.push_back({a, b, c});
    for (const Vec3& x : triangles_.back()) box_.extend(x);
  };
  for (std::size_t k = 1; k < sweep.blades.size(); ++k) {
    const auto& [tip, end] = sweep.blades[k - 1];
    const auto& [next_tip, next_end] = sweep.blades[k];
    add(tip, end, next_tip);
    add(next_tip, end, next_end);
  }
}

std::optional<double> SweptSurface::crossing(const Vec3& a, const Vec3& b) const {
  std::optional<double> first;
  Eigen::AlignedBox3d segment(a.cwiseMin(b), a.cwiseMax(b));
  if (!segment.intersects(box_)) return first;
  for (const auto& triangle : triangles_)
    if (const auto at = segment_triangle_crossing(a, b, triangle)) first = first ? std::min(*first, *at) : *at;
  return first;
}

SweptSurface::Nearest SweptSurface::nearest(const Vec3& to) const {
  Nearest nearest{Vec3::Zero(), Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (const auto& t : triangles_) {
    const Vec3 point = nearest_point(to, t);
    const double distance = (point - to).norm();
    if (distance < nearest.distance) nearest = {point, (t[1] - t[0]).cross(t[2] - t[0]).normalized(), distance};
  }
  return nearest;
}

}  // namespace heml
