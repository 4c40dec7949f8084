#include "shape.hpp"

#include <algorithm>
#include <cmath>

namespace heml::make {

double ellipsoid(const Vec3& p, const Vec3& centre, const Vec3& radii) {
  const Vec3 q = (p - centre).cwiseQuotient(radii);
  const double k0 = q.norm(), k1 = q.cwiseQuotient(radii).norm();
  return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
}

Tube::Tube(const std::vector<Station>& stations) {
  constexpr int pieces = 8;  // a span of a few centimetres becomes segments shorter than an edge of the mesh
  const int last = static_cast<int>(stations.size()) - 1;
  for (int i = 0; i < last; ++i) {
    const Station& a = stations[std::max(i - 1, 0)];
    const Station& b = stations[i];
    const Station& c = stations[i + 1];
    const Station& d = stations[std::min(i + 2, last)];
    for (int j = 0; j < pieces; ++j) {
      const double t = double(j) / pieces;
      const auto blend = [t](auto p, auto q, auto r, auto s) {
        return 0.5 * (2 * q + t * (r - p) + t * t * (2 * p - 5 * q + 4 * r - s) + t * t * t * (3 * q - p - 3 * r + s));
      };
      Station sample;
      for (int axis = 0; axis < 3; ++axis)
        sample.centre[axis] = blend(a.centre[axis], b.centre[axis], c.centre[axis], d.centre[axis]);
      sample.radius = blend(a.radius, b.radius, c.radius, d.radius);
      samples_.push_back(sample);
    }
  }
  samples_.push_back(stations.back());
}

double Tube::distance(const Vec3& p) const {
  double nearest = 1e300;
  for (std::size_t i = 0; i + 1 < samples_.size(); ++i) {
    const Station &a = samples_[i], &b = samples_[i + 1];
    const Vec3 axis = b.centre - a.centre;
    const double t = std::clamp((p - a.centre).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a.centre - t * axis).norm() - std::lerp(a.radius, b.radius, t));
  }
  return nearest;
}

Vec3 Tube::direction() const { return (samples_.back().centre - samples_[samples_.size() - 2].centre).normalized(); }

double half_space(const Vec3& p, const Vec3& origin, const Vec3& normal) { return (p - origin).dot(normal); }

double smooth_union(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend / 4;
}
double smooth_intersection(double a, double b, double blend) { return -smooth_union(-a, -b, blend); }
double smooth_cut(double a, double b, double blend) { return smooth_intersection(a, -b, blend); }

Vec3 gradient(const Shape& shape, const Vec3& p) {
  constexpr double h = 1e-6;  // m
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 step = h * Vec3::Unit(axis);
    result[axis] = (shape(p + step) - shape(p - step)) / (2 * h);
  }
  return result;
}

Vec3 project(const Shape& shape, Vec3 p) {
  for (int iteration = 0; iteration < 8; ++iteration) {
    const double value = shape(p);
    const Vec3 g = gradient(shape, p);
    if (std::abs(value) < 1e-9 || g.squaredNorm() < 1e-6) break;
    Vec3 step = value / g.squaredNorm() * g;
    constexpr double longest = 2e-3;  // m; keeps a bad gradient from throwing the point across the body
    if (step.norm() > longest) step *= longest / step.norm();
    p -= step;
  }
  return p;
}

}  // namespace heml::make
