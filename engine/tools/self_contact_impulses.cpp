#include <algorithm>
#include <cmath>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {
namespace {

constexpr int most_rounds = 60;
constexpr double still = 1e-8;     // of the largest impulse: smaller changes end the rounds
constexpr double recovery = 0.01;  // s, in which tissue that was inside from the start comes out
constexpr double has_met = 1e-7;   // m

template <class Real>
Vec3 at(const Real* values, int node) {
  return Eigen::Map<const Vector3<Real>>(values + 3 * node).template cast<double>();
}

template <class Real>
Vec3 at(const Real* values, const ContactPoint& point) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) sum += point.weights[k] * at(values, point.nodes[k]);
  return sum;
}

template <class Real>
double inverse_mass_of(const ContactPoint& point, const std::vector<Real>& inverse_mass) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k)
    sum += point.weights[k] * point.weights[k] *
           static_cast<double>(inverse_mass[static_cast<std::size_t>(point.nodes[k])]);
  return sum;
}

}  // namespace

template <class Real>
void SelfContactImpulses<Real>::meet(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                     const Real* before, const Real* after) {
  friction_ = contact.friction();
  touches_.clear();
  const auto from = [&](int n) { return at(before, n); };
  for (const SkinPair& pair : contact.meeting(from, [&](int n) { return at(after, n); })) {
    const auto point = point_of(pair, from);
    const double light = inverse_mass_of(*point, inverse_mass);
    if (!(light > 0)) continue;
    const double may = std::min(0.0, point->gap) * std::max(0.0, 1 - h / recovery);
    touches_.push_back({pair, *point, (may - point->gap) / h, light, point->gap <= has_met});
  }
}

template <class Real>
void SelfContactImpulses<Real>::stop(const std::vector<Real>& inverse_mass, const Real* x) {
  std::erase_if(touches_, [](const Touch& touch) { return !(touch.normal > 0); });
  for (Touch& touch : touches_) {
    if (const auto now = point_of(touch.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    touch.light = inverse_mass_of(touch.point, inverse_mass);
    touch.least = touch.normal = touch.work = 0;
    touch.rubs = true;
    touch.along.setZero();
  }
}

template <class Real>
void SelfContactImpulses<Real>::push(const std::vector<Real>& inverse_mass, Real* v) {
  for (int round = 0; round < most_rounds; ++round) {
    double largest = 0, change = 0;
    for (Touch& touch : touches_) {
      change = std::max(change, push(touch, inverse_mass, v));
      largest = std::max(largest, touch.normal);
    }
    if (change <= still * largest) return;
  }
}

/// One pair's turn. Returns how much its impulses have changed, N s.
template <class Real>
double SelfContactImpulses<Real>::push(Touch& touch, const std::vector<Real>& inverse_mass, Real* v) const {
  const Vec3& n = touch.point.normal;
  const double normal = std::max(0.0, touch.normal + (touch.least - n.dot(at(v, touch.point))) / touch.light);
  double change = std::abs(normal - touch.normal);
  if (change > 0) add(touch, (normal - touch.normal) * n, inverse_mass, v);
  touch.normal = normal;
  if (!(friction_ > 0) || !touch.rubs) return change;
  const Vec3 u = at(v, touch.point);
  Vec3 along = touch.along - (u - n.dot(u) * n) / touch.light;
  const double size = along.norm(), most = friction_ * normal;
  if (size > most) along *= most / size;
  const Vec3 more = along - touch.along;
  touch.along = along;
  if (!more.isZero(0)) add(touch, more, inverse_mass, v);
  touch.work += more.dot(u + more * (touch.light / 2));
  return std::max(change, more.norm());
}

template <class Real>
void SelfContactImpulses<Real>::add(const Touch& touch, const Vec3& impulse, const std::vector<Real>& inverse_mass,
                                    Real* v) const {
  for (std::size_t k = 0; k < 4; ++k) {
    const int n = touch.point.nodes[k];
    Eigen::Map<Vector3<Real>>(v + 3 * n) +=
        (touch.point.weights[k] * static_cast<double>(inverse_mass[static_cast<std::size_t>(n)]) * impulse)
            .template cast<Real>();
  }
}

template <class Real>
void SelfContactImpulses<Real>::tell(double weight, double& pressed, ContactDeeds& deeds) const {
  for (const Touch& touch : touches_) {
    pressed += weight * touch.normal;
    deeds.work += weight * touch.work;
  }
}

template class SelfContactImpulses<float>;
template class SelfContactImpulses<double>;

}  // namespace heml
