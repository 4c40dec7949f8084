#include <algorithm>
#include <cmath>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {
namespace {

constexpr int max_pair_rounds = 60;
constexpr double change_tolerance = 1e-8;  // of the largest impulse: smaller changes end the iteration
constexpr double touching_gap = 1e-7;      // m, largest gap at which friction acts

}  // namespace

template <class Real>
void SelfContactImpulses<Real>::find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                           const Real* before, const Real* after) {
  friction_ = contact.friction();
  active_.clear();
  const auto from = [&](int n) { return at(before, n); };
  for (const ContactPair& pair : contact.contacts_between(from, [&](int n) { return at(after, n); })) {
    const auto point = point_of(pair, from);
    const double effective_inverse_mass = inverse_mass_of(*point, inverse_mass);
    if (!(effective_inverse_mass > 0)) continue;
    const double allowed_gap = std::min(0.0, point->gap) * std::max(0.0, 1 - h / contact_recovery);
    active_.push_back(
        {pair, *point, (allowed_gap - point->gap) / h, effective_inverse_mass, point->gap <= touching_gap});
  }
}

template <class Real>
void SelfContactImpulses<Real>::begin_second_half(const std::vector<Real>& inverse_mass, const Real* x) {
  std::erase_if(active_, [](const ActiveContact& touch) { return !(touch.normal > 0); });
  for (ActiveContact& touch : active_) {
    if (const auto now = point_of(touch.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    touch.inverse_mass = inverse_mass_of(touch.point, inverse_mass);
    touch.min_gap_rate = touch.normal = touch.work = 0;
    touch.has_friction = true;
    touch.friction_impulse.setZero();
  }
}

template <class Real>
void SelfContactImpulses<Real>::solve(const std::vector<Real>& inverse_mass, Real* v) {
  for (int round = 0; round < max_pair_rounds; ++round) {
    double largest = 0, change = 0;
    for (ActiveContact& touch : active_) {
      change = std::max(change, solve_pair(touch, inverse_mass, v));
      largest = std::max(largest, touch.normal);
    }
    if (change <= change_tolerance * largest) return;
  }
}

/// Updates one pair's impulses. Returns their change, N s.
template <class Real>
double SelfContactImpulses<Real>::solve_pair(ActiveContact& touch, const std::vector<Real>& inverse_mass,
                                             Real* v) const {
  const Vec3& n = touch.point.normal;
  const double normal =
      std::max(0.0, touch.normal + (touch.min_gap_rate - n.dot(at(v, touch.point))) / touch.inverse_mass);
  double change = std::abs(normal - touch.normal);
  if (change > 0) apply_impulse(touch.point, (normal - touch.normal) * n, inverse_mass, v);
  touch.normal = normal;
  if (!(friction_ > 0) || !touch.has_friction) return change;
  const Vec3 u = at(v, touch.point);
  Vec3 friction_impulse = touch.friction_impulse - (u - n.dot(u) * n) / touch.inverse_mass;
  const double size = friction_impulse.norm(), max_friction = friction_ * normal;
  if (size > max_friction) friction_impulse *= max_friction / size;
  const Vec3 correction = friction_impulse - touch.friction_impulse;
  touch.friction_impulse = friction_impulse;
  if (!correction.isZero(0)) apply_impulse(touch.point, correction, inverse_mass, v);
  touch.work += correction.dot(u + correction * (touch.inverse_mass / 2));
  return std::max(change, correction.norm());
}

template <class Real>
void SelfContactImpulses<Real>::publish(double weight, double& normal_force, ContactReport& report) const {
  for (const ActiveContact& touch : active_) {
    normal_force += weight * touch.normal;
    report.work += weight * touch.work;
  }
}

template class SelfContactImpulses<float>;
template class SelfContactImpulses<double>;

}  // namespace heml
