#include <algorithm>
#include <cmath>
#include <heml/math/closest.hpp>
#include <heml/tools/contact_surface.hpp>

namespace heml {
namespace {

/// A point of a triangle, by barycentric weights, and a point of the capsule's axis.
struct Pair {
  std::array<double, 3> weights;
  Vec3 on_axis;
  double distance;
};

Pair nearest_pair(const ContactSurface& capsule, const std::array<Vec3, 3>& x) {
  const auto on_face = [&](const std::array<double, 3>& w) -> Vec3 { return w[0] * x[0] + w[1] * x[1] + w[2] * x[2]; };
  Pair best{{}, Vec3::Zero(), -1};
  const auto keep_nearest = [&](const std::array<double, 3>& weights, const Vec3& on_axis) {
    const double distance = (on_face(weights) - on_axis).norm();
    if (best.distance < 0 || distance < best.distance) best = {weights, on_axis, distance};
  };
  keep_nearest(closest_point_weights(capsule.point, x[0], x[1], x[2]), capsule.point);
  const Vec3 axis = capsule.other - capsule.point;
  if (axis.isZero(0)) return best;
  keep_nearest(closest_point_weights(capsule.other, x[0], x[1], x[2]), capsule.other);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto [s, t] = closest_on_segments(capsule.point, axis, x[i], x[j] - x[i]);
    std::array<double, 3> weights{};
    weights[i] = 1 - t;
    weights[j] = t;
    keep_nearest(weights, capsule.point + s * axis);
  }
  return best;
}

/// Contact of a face that the axis passes through, at `where` of it (0 at the tip): the point there, out along the
/// face's normal over the end of the axis that is less deep. With the end on the face this is the contact of the end.
ContactPoint pierced_face_contact(const ContactSurface& capsule, const Triangle& face, const std::array<Vec3, 3>& x,
                                  double where) {
  const auto [u, v, w] =
      closest_point_weights(capsule.point + where * (capsule.other - capsule.point), x[0], x[1], x[2]);
  const Vec3 normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
  const double tip = normal.dot(capsule.point - x[0]), other = normal.dot(capsule.other - x[0]);
  const double height = std::abs(tip) < std::abs(other) ? tip : other;
  return {{face[0], face[1], face[2], face[0]},
          {u, v, w, 0},
          3,
          -std::abs(height) - capsule.radius,
          height < 0 ? Vec3(-normal) : normal};
}

}  // namespace

void Probe::go(const std::vector<Vec3>& path, double speed, double time) {
  std::vector<Vec3> waypoints;
  if (!path_.empty()) waypoints.push_back(tip(time));
  waypoints.insert(waypoints.end(), path.begin(), path.end());
  path_ = std::move(waypoints);
  speed_ = speed;
  start_ = time;
}

Vec3 Probe::tip(double time) const {
  double left = speed_ * std::max(0.0, time - start_);
  for (std::size_t k = 1; k < path_.size(); ++k) {
    const Vec3 segment = path_[k] - path_[k - 1];
    const double length = segment.norm();
    if (left < length) return path_[k - 1] + left / length * segment;
    left -= length;
  }
  return path_.back();
}

double Suture::length(double time) const {
  const double part = ramp_time > 0 ? std::clamp((time - start) / ramp_time, 0.0, 1.0) : 1;
  return from + part * (to - from);
}

ContactSurface surface_of(const PlacedTable& placed, double time) {
  const Table& table = placed.table;
  const double below = placed.rises(time) ? placed.depth - placed.speed * (time - placed.start) : 0;
  return {ContactSurface::Shape::plane, table.point - below * table.normal, table.normal, 0, table.friction};
}

ContactSurface surface_of(const Suture& suture, double time) {
  return {ContactSurface::Shape::thread, Vec3::Zero(), Vec3::Zero(), suture.length(time), 0, suture.nodes};
}

ContactSurface surface_of(const Probe& probe, double time) {
  const Vec3 tip = probe.tip(time);
  return {ContactSurface::Shape::capsule, tip, tip + probe.shaft(), probe.radius(), probe.friction()};
}

std::optional<ContactPoint> capsule_face_contact(const ContactSurface& capsule, const Triangle& face, const Vec3& a,
                                                 const Vec3& b, const Vec3& c, double reach) {
  const std::array<Vec3, 3> x{a, b, c};
  if (const auto where = segment_triangle_crossing(capsule.point, capsule.other, x))
    return pierced_face_contact(capsule, face, x, *where);
  const Pair pair = nearest_pair(capsule, x);
  if (!(pair.distance < capsule.radius + reach) || !(pair.distance > 1e-9 * capsule.radius)) return std::nullopt;
  const Vec3 point = pair.weights[0] * a + pair.weights[1] * b + pair.weights[2] * c;
  const auto [u, v, w] = pair.weights;
  return ContactPoint{{face[0], face[1], face[2], face[0]},
                      {u, v, w, 0},
                      3,
                      pair.distance - capsule.radius,
                      (point - pair.on_axis) / pair.distance};
}

bool may_touch(const ContactSurface& capsule, const Vec3& a, const Vec3& b, const Vec3& c, double reach) {
  const Vec3 axis = capsule.other - capsule.point;
  const double square = axis.squaredNorm();
  const double along = square > 0 ? std::clamp(axis.dot(a - capsule.point) / square, 0.0, 1.0) : 0;
  const double size = std::max((b - a).squaredNorm(), (c - a).squaredNorm());
  const double within = capsule.radius + reach;
  // Nothing of the face is further from a than √size, and (√size + within)² ≤ 2 size + 2 within².
  return !((a - capsule.point - along * axis).squaredNorm() > 2.0001 * (size + within * within));
}

std::optional<ContactPoint> thread_contact(const ContactSurface& thread, const Vec3& a, const Vec3& b, double reach) {
  const double length = (a - b).norm(), gap = thread.radius - length;
  if (!(gap < reach) || !(length > 0)) return std::nullopt;
  const auto [first, second] = thread.ends;
  return ContactPoint{{first, second, first, first}, {1, -1, 0, 0}, 2, gap, (b - a) / length};
}

}  // namespace heml
