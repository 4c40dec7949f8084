#pragma once
// Values and impulses at contact points, as weighted sums over their nodes. Positions and velocities are #V×3, inverse
// masses #V, 1/kg.

#include <heml/tools/contact_surface.hpp>
#include <vector>

namespace heml {

/// s, time constant with which penetration present at a step's start decays.
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

/// Effective inverse mass of a contact point, 1/kg.
template <class Real>
double inverse_mass_of(const ContactPoint& point, const std::vector<Real>& inverse_mass) {
  double sum = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
    sum += point.weights[k] * point.weights[k] *
           static_cast<double>(inverse_mass[static_cast<std::size_t>(point.nodes[k])]);
  return sum;
}

/// Applies an impulse (N s) to a contact point: changes the velocities v (m/s) of its nodes.
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
