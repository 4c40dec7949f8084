#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/sweep.hpp>
#include <limits>

namespace heml {

SweptSurface::SweptSurface(const Sweep& sweep, const Vec3& normal) {
  Vec3 upper = normal;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    const Vec3 product = (b - a).cross(c - a);
    if (product.norm() <= 1e-12 * longest) return;
    upper = (product.dot(upper) < 0 ? -1 : 1) * product.normalized();
    Eigen::AlignedBox3d box(a);
    box.extend(b).extend(c);
    triangles_.push_back({{a, b, c}, upper, box});
    box_.extend(box);
  };
  for (std::size_t k = 1; k < sweep.blades.size(); ++k) {
    const auto& [tip, end] = sweep.blades[k - 1];
    const auto& [next_tip, next_end] = sweep.blades[k];
    add(tip, end, next_tip);
    add(next_tip, end, next_end);
  }
}

Vec3 SweptSurface::last_normal() const { return triangles_.empty() ? Vec3(Vec3::Zero()) : triangles_.back().normal; }

std::optional<SweptSurface::Crossing> SweptSurface::crossing(const Vec3& a, const Vec3& b) const {
  std::optional<Crossing> first;
  const Eigen::AlignedBox3d segment(a.cwiseMin(b), a.cwiseMax(b));
  if (!segment.intersects(box_)) return first;
  for (const Triangle& triangle : triangles_) {
    if (!segment.intersects(triangle.box)) continue;
    const auto at = segment_triangle_crossing(a, b, triangle.corners);
    if (!at) continue;
    if (!first)
      first = {*at, triangle.normal.dot(a - b) > 0};
    else
      first->where = std::min(first->where, *at);
  }
  return first;
}

SweptSurface::Nearest SweptSurface::nearest(const Vec3& to) const {
  Nearest nearest{Vec3::Zero(), Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (const Triangle& triangle : triangles_) {
    const auto& t = triangle.corners;
    const auto [u, v, w] = closest_point_weights(to, t[0], t[1], t[2]);
    const Vec3 point = u * t[0] + v * t[1] + w * t[2];
    const double distance = (point - to).norm();
    if (distance < nearest.distance) nearest = {point, (t[1] - t[0]).cross(t[2] - t[0]).normalized(), distance};
  }
  return nearest;
}

}  // namespace heml
