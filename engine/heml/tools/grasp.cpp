#include <algorithm>
#include <cmath>
#include <heml/tools/grasp.hpp>

namespace heml {

template <class Real>
GraspSpring<Real>::GraspSpring(GraspId id, int center, Real radius, std::span<const int> nodes,
                               const std::vector<Vec3>& rest, const Real* x, const std::vector<Real>& inverse_mass,
                               Real omega, double reach)
    : id_(id), center_(center), radius_(radius), omega_(omega), reach_(reach) {
  const auto at = [x](int n) { return Vec3(Eigen::Map<const Vector3<Real>>(x + 3 * n).template cast<double>()); };
  target_ = at(center);
  const auto take = [&](int n, Real weight) {
    if (inverse_mass[static_cast<std::size_t>(n)] == 0) return;
    nodes_.push_back(n);
    offset_.push_back(at(n) - target_);
    weight_.push_back(weight);
  };
  for (const int n : nodes) {
    if (n == center) {
      take(n, 1);
      continue;
    }
    const double distance = (rest[static_cast<std::size_t>(n)] - rest[static_cast<std::size_t>(center)]).norm();
    if (!(distance < static_cast<double>(radius))) continue;
    const Real inside = Real(1) - static_cast<Real>(distance * distance) / (radius * radius);
    take(n, inside * inside);
  }
  update_masses(inverse_mass);
}

template <class Real>
void GraspSpring<Real>::update_masses(const std::vector<Real>& inverse_mass) {
  stiffness_.resize(nodes_.size());
  damping_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Real m = inverse_mass[static_cast<std::size_t>(nodes_[k])];
    stiffness_[k] = m > 0 ? weight_[k] * omega_ * omega_ / m : Real(0);
    damping_[k] = m > 0 ? 2 * std::sqrt(weight_[k]) * omega_ / m : Real(0);
  }
}

template <class Real>
Vec3 GraspSpring<Real>::clamped_target(const Real* x) const {
  const Vec3 from = grip(x), pull = target_ - from;
  const double length = pull.norm();
  return length > reach_ ? Vec3(from + reach_ / length * pull) : target_;
}

template <class Real>
Vector3<Real> GraspSpring<Real>::node_force(std::size_t k, const Vec3& target, const Real* x, const Real* v) const {
  const int n = nodes_[k];
  const Vector3<Real> goal = (target + offset_[k]).template cast<Real>();
  return stiffness_[k] * (goal - Eigen::Map<const Vector3<Real>>(x + 3 * n)) -
         damping_[k] * Eigen::Map<const Vector3<Real>>(v + 3 * n);
}

template <class Real>
void GraspSpring<Real>::add_forces(const Real* x, const Real* v, Real* f) const {
  const Vec3 target = clamped_target(x);
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    Eigen::Map<Vector3<Real>>(f + 3 * nodes_[k]) += node_force(k, target, x, v);
}

/// Energy of the springs relative to the grip, plus that of the grip relative to the tool, which is quadratic within
/// reach and linear beyond.
template <class Real>
double GraspSpring<Real>::energy(const Real* x) const {
  const Vec3 from = grip(x);
  double sum = 0, total = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Vec3 at = Eigen::Map<const Vector3<Real>>(x + 3 * nodes_[k]).template cast<double>();
    sum += static_cast<double>(stiffness_[k]) / 2 * (at - offset_[k] - from).squaredNorm();
    total += static_cast<double>(stiffness_[k]);
  }
  const double length = (target_ - from).norm(), held = std::min(length, reach_);
  return sum + total * held * (length - held / 2);
}

template <class Real>
Vec3 GraspSpring<Real>::grip(const Real* x) const {
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const double w = static_cast<double>(stiffness_[k]);
    sum += w * (Vec3(Eigen::Map<const Vector3<Real>>(x + 3 * nodes_[k]).template cast<double>()) - offset_[k]);
    weight += w;
  }
  return weight > 0 ? Vec3(sum / weight) : target_;
}

template <class Real>
double GraspSpring<Real>::speed_at_most(const Real* x) const {
  return static_cast<double>(omega_) / 2 * std::min((target_ - grip(x)).norm(), reach_);
}

template <class Real>
Vec3 GraspSpring<Real>::force(const Real* x, const Real* v) const {
  const Vec3 target = clamped_target(x);
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < nodes_.size(); ++k) sum += node_force(k, target, x, v).template cast<double>();
  return sum;
}

template class GraspSpring<float>;
template class GraspSpring<double>;

}  // namespace heml
