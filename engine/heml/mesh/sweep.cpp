#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/sweep.hpp>
#include <limits>

namespace heml {

void Heading::turn(const std::array<Vec3, 2>& from, const std::array<Vec3, 2>& to) {
  const Vec3 next = (to[0] - from[0] + to[1] - from[1]) / 2;
  if (next.isZero(0)) return;
  if (next.dot(motion) < 0) sign = -sign;
  motion = next;
}

OrientedSweep oriented(const Sweep& sweep, Heading heading) {
  OrientedSweep result{sweep, {}, heading};
  for (std::size_t k = 1; k < sweep.blades.size(); ++k) {
    result.heading.turn(sweep.blades[k - 1], sweep.blades[k]);
    result.signs.push_back(result.heading.sign);
  }
  return result;
}

SweptSurface::SweptSurface(const OrientedSweep& oriented) {
  const std::vector<std::array<Vec3, 2>>& blades = oriented.sweep.blades;
  int sign = 1;
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double longest = std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
    const Vec3 product = (b - a).cross(c - a);
    if (product.norm() <= 1e-12 * longest) return;
    Eigen::AlignedBox3d box(a);
    box.extend(b).extend(c);
    triangles_.push_back({{a, b, c}, sign * product.normalized(), box});
    box_.extend(box);
  };
  for (std::size_t k = 1; k < blades.size(); ++k) {
    const auto& [tip, end] = blades[k - 1];
    const auto& [next_tip, next_end] = blades[k];
    sign = oriented.signs[k - 1];
    add(tip, end, next_tip);
    add(next_tip, end, next_end);
  }
}

std::optional<SweptSurface::Crossing> SweptSurface::crossing(const Vec3& a, const Vec3& b) const {
  const Eigen::AlignedBox3d segment(a.cwiseMin(b), a.cwiseMax(b));
  if (!segment.intersects(box_)) return std::nullopt;
  int downwards = 0;                  // intersections from the upper side, less those from the other
  std::array<double, 2> first{2, 2};  // along the segment: from the other side, from the upper one
  for (const Triangle& triangle : triangles_) {
    if (!segment.intersects(triangle.box)) continue;
    const auto at = segment_triangle_crossing(a, b, triangle.corners);
    if (!at) continue;
    const bool from_top = triangle.normal.dot(a - b) > 0;
    downwards += from_top ? 1 : -1;
    first[from_top] = std::min(first[from_top], *at);
  }
  if (downwards == 0) return std::nullopt;
  return Crossing{first[downwards > 0], downwards > 0};
}

SweptSurface::Nearest SweptSurface::nearest(const Vec3& to) const {
  Nearest nearest{Vec3::Zero(), Vec3::Zero(), std::numeric_limits<double>::infinity()};
  for (const Triangle& triangle : triangles_) {
    const auto& t = triangle.corners;
    const auto [u, v, w] = closest_point_weights(to, t[0], t[1], t[2]);
    const Vec3 point = u * t[0] + v * t[1] + w * t[2];
    const double distance = (point - to).norm();
    if (distance < nearest.distance) nearest = {point, triangle.normal, distance};
  }
  return nearest;
}

}  // namespace heml
