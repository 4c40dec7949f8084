#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/mesh/sweep.hpp>
#include <limits>

namespace heml {

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
    const auto [u, v, w] = closest_point_weights(to, t[0], t[1], t[2]);
    const Vec3 point = u * t[0] + v * t[1] + w * t[2];
    const double distance = (point - to).norm();
    if (distance < nearest.distance) nearest = {point, (t[1] - t[0]).cross(t[2] - t[0]).normalized(), distance};
  }
  return nearest;
}

}  // namespace heml
