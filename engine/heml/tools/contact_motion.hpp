#pragma once
// What impulses do to points of contact: sums over their nodes. Positions and velocities are 3 #V, inverse masses #V,
// 1/kg.

#include <heml/tools/contact_surface.hpp>
#include <vector>

namespace heml {

/// s, in which tissue that was inside from the start comes out.
inline constexpr double contact_recovery = 0.01;

template <class Real>
Vec3 at(const Real* values, int node) {
  return Eigen::Map<const Vector3<Real>>(values + 3 * node).template cast<double>();
}

template <class Real>
Vec3 at(const Real* values, const ContactPoint& point) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
    sum += point.weights[k] * at(values, point.nodes[k]);
  return sum;
}

/// Of a point's motion along a direction, 1/kg.
template <class Real>
double inverse_mass_of(const ContactPoint& point, const std::vector<Real>& inverse_mass) {
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
    sum += point.weights[k] * point.weights[k] *
           static_cast<double>(inverse_mass[static_cast<std::size_t>(point.nodes[k])]);
  return sum;
}

/// impulse: N s, on the point. Changes the velocities v of its nodes, m/s.
template <class Real>
void apply_impulse(const ContactPoint& point, const Vec3& impulse, const std::vector<Real>& inverse_mass, Real* v) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k) {
    const int n = point.nodes[k];
    Eigen::Map<Vector3<Real>>(v + 3 * n) +=
        (point.weights[k] * static_cast<double>(inverse_mass[static_cast<std::size_t>(n)]) * impulse)
            .template cast<Real>();
  }
}

}  // namespace heml
