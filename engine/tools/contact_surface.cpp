#include <algorithm>
#include <cmath>
#include <heml/tools/contact_surface.hpp>

namespace heml {
namespace {

/// A point of a triangle by its weights, and a point of the capsule's axis.
struct Pair {
  std::array<double, 3> weights;
  Vec3 on_axis;
  double distance;
};

/// The point of a triangle nearest to p (C. Ericson, Real-Time Collision Detection, 2005, 5.1.5).
std::array<double, 3> nearest_weights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
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

/// Parameters 0 to 1 of the nearest points of two segments (Ericson 2005, 5.1.9); the first may be a point.
std::pair<double, double> nearest_on_segments(const Vec3& p, const Vec3& u, const Vec3& q, const Vec3& v) {
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

Pair nearest_pair(const ContactSurface& capsule, const std::array<Vec3, 3>& x) {
  const auto on_face = [&](const std::array<double, 3>& w) -> Vec3 { return w[0] * x[0] + w[1] * x[1] + w[2] * x[2]; };
  Pair best{{}, Vec3::Zero(), -1};
  const auto offer = [&](const std::array<double, 3>& weights, const Vec3& on_axis) {
    const double distance = (on_face(weights) - on_axis).norm();
    if (best.distance < 0 || distance < best.distance) best = {weights, on_axis, distance};
  };
  offer(nearest_weights(capsule.point, x[0], x[1], x[2]), capsule.point);
  const Vec3 axis = capsule.other - capsule.point;
  if (axis.isZero(0)) return best;
  offer(nearest_weights(capsule.other, x[0], x[1], x[2]), capsule.other);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const auto [s, t] = nearest_on_segments(capsule.point, axis, x[i], x[j] - x[i]);
    std::array<double, 3> weights{};
    weights[i] = 1 - t;
    weights[j] = t;
    offer(weights, capsule.point + s * axis);
  }
  return best;
}

}  // namespace

void Probe::go(const std::vector<Vec3>& path, double speed, double time) {
  std::vector<Vec3> way;
  if (!path_.empty()) way.push_back(tip(time));
  way.insert(way.end(), path.begin(), path.end());
  path_ = std::move(way);
  speed_ = speed;
  start_ = time;
}

Vec3 Probe::tip(double time) const {
  double left = speed_ * std::max(0.0, time - start_);
  for (std::size_t k = 1; k < path_.size(); ++k) {
    const Vec3 way = path_[k] - path_[k - 1];
    const double length = way.norm();
    if (left < length) return path_[k - 1] + left / length * way;
    left -= length;
  }
  return path_.back();
}

double Suture::length(double time) const {
  const double part = over > 0 ? std::clamp((time - start) / over, 0.0, 1.0) : 1;
  return from + part * (to - from);
}

ContactSurface surface_of(const Table& table) {
  return {ContactSurface::Shape::plane, table.point, table.normal, 0, table.friction};
}

ContactSurface surface_of(const Suture& suture, double time) {
  return {ContactSurface::Shape::thread, Vec3::Zero(), Vec3::Zero(), suture.length(time), 0, suture.nodes};
}

ContactSurface surface_of(const Probe& probe, double time) {
  const Vec3 tip = probe.tip(time);
  return {ContactSurface::Shape::capsule, tip, tip + probe.shaft(), probe.radius(), probe.friction()};
}

std::optional<ContactPoint> near_face(const ContactSurface& capsule, const Triangle& face, const Vec3& a, const Vec3& b,
                                      const Vec3& c, double reach) {
  const std::array<Vec3, 3> x{a, b, c};
  const Pair pair = nearest_pair(capsule, x);
  if (!(pair.distance < capsule.radius + reach) || !(pair.distance > 1e-9 * capsule.radius)) return std::nullopt;
  const Vec3 point = pair.weights[0] * a + pair.weights[1] * b + pair.weights[2] * c;
  return ContactPoint{face, pair.weights, 3, pair.distance - capsule.radius, (point - pair.on_axis) / pair.distance};
}

std::optional<ContactPoint> near_end(const ContactSurface& thread, const Vec3& a, const Vec3& b, double reach) {
  const double length = (a - b).norm(), gap = thread.radius - length;
  if (!(gap < reach) || !(length > 0)) return std::nullopt;
  const auto [first, second] = thread.ends;
  return ContactPoint{{first, second, second}, {1, -1, 0}, 2, gap, (b - a) / length};
}

}  // namespace heml
