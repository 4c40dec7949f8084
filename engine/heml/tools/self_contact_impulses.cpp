#include <algorithm>
#include <cmath>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {
namespace {

constexpr int max_pair_rounds = 60;
constexpr double still = 1e-8;    // of the largest impulse: smaller changes end the iteration
constexpr double has_met = 1e-7;  // m, largest gap at which friction acts

}  // namespace

template <class Real>
void SelfContactImpulses<Real>::meet(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                     const Real* before, const Real* after) {
  friction_ = contact.friction();
  active_.clear();
  const auto from = [&](int n) { return at(before, n); };
  for (const ContactPair& pair : contact.contacts_between(from, [&](int n) { return at(after, n); })) {
    const auto point = point_of(pair, from);
    const double light = inverse_mass_of(*point, inverse_mass);
    if (!(light > 0)) continue;
    const double may = std::min(0.0, point->gap) * std::max(0.0, 1 - h / contact_recovery);
    active_.push_back({pair, *point, (may - point->gap) / h, light, point->gap <= has_met});
  }
}

template <class Real>
void SelfContactImpulses<Real>::stop(const std::vector<Real>& inverse_mass, const Real* x) {
  std::erase_if(active_, [](const ActiveContact& touch) { return !(touch.normal > 0); });
  for (ActiveContact& touch : active_) {
    if (const auto now = point_of(touch.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    touch.light = inverse_mass_of(touch.point, inverse_mass);
    touch.least = touch.normal = touch.work = 0;
    touch.rubs = true;
    touch.along.setZero();
  }
}

template <class Real>
void SelfContactImpulses<Real>::push(const std::vector<Real>& inverse_mass, Real* v) {
  for (int round = 0; round < max_pair_rounds; ++round) {
    double largest = 0, change = 0;
    for (ActiveContact& touch : active_) {
      change = std::max(change, push(touch, inverse_mass, v));
      largest = std::max(largest, touch.normal);
    }
    if (change <= still * largest) return;
  }
}

/// Updates one pair's impulses. Returns their change, N s.
template <class Real>
double SelfContactImpulses<Real>::push(ActiveContact& touch, const std::vector<Real>& inverse_mass, Real* v) const {
  const Vec3& n = touch.point.normal;
  const double normal = std::max(0.0, touch.normal + (touch.least - n.dot(at(v, touch.point))) / touch.light);
  double change = std::abs(normal - touch.normal);
  if (change > 0) apply_impulse(touch.point, (normal - touch.normal) * n, inverse_mass, v);
  touch.normal = normal;
  if (!(friction_ > 0) || !touch.rubs) return change;
  const Vec3 u = at(v, touch.point);
  Vec3 along = touch.along - (u - n.dot(u) * n) / touch.light;
  const double size = along.norm(), most = friction_ * normal;
  if (size > most) along *= most / size;
  const Vec3 more = along - touch.along;
  touch.along = along;
  if (!more.isZero(0)) apply_impulse(touch.point, more, inverse_mass, v);
  touch.work += more.dot(u + more * (touch.light / 2));
  return std::max(change, more.norm());
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
