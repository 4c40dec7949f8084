#include <algorithm>
#include <cmath>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {
namespace {

/// When the iteration ends.
struct Limit {
  int rounds;
  double tolerance;  ///< of the largest impulse: smaller changes end it
};
constexpr Limit cold_limit{60, 1e-8};  // where a pair is new
constexpr Limit warm_limit{4, 1e-4};   // where all were there in earlier steps: the next step goes on from here

constexpr double touching_gap = 1e-7;  // m, largest gap at which friction acts

/// What apply_impulse() multiplies an impulse with, 1/kg.
template <class Real>
std::array<double, 4> mobility_of(const ContactPoint& point, const std::vector<Real>& inverse_mass) {
  std::array<double, 4> mobility;
  for (std::size_t k = 0; k < 4; ++k)
    mobility[k] = point.weights[k] * static_cast<double>(inverse_mass[static_cast<std::size_t>(point.nodes[k])]);
  return mobility;
}

/// at() and apply_impulse() for the four nodes of a pair, where most of the time goes.
template <class Real>
Vec3 velocity_of(const ContactPoint& point, const Real* v) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < 4; ++k) sum += point.weights[k] * heml::at(v, point.nodes[k]);
  return sum;
}
template <class Real>
void add_impulse(const ContactPoint& point, const std::array<double, 4>& mobility, const Vec3& impulse, Real* v) {
  for (std::size_t k = 0; k < 4; ++k)
    Eigen::Map<Vector3<Real>>(v + 3 * point.nodes[k]) += (mobility[k] * impulse).template cast<Real>();
}

}  // namespace

template <class Real>
void SelfContactImpulses<Real>::find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                           const Real* before, const Real* after,
                                           const std::vector<RememberedPair>& known) {
  friction_ = contact.friction();
  active_.clear();
  half_ = 0;
  is_warm_ = true;
  rounds_ = 0;
  residual_ = 0;
  const auto from = [&](int n) { return at(before, n); };
  auto next = known.begin();
  for (const ContactPair& pair : contact.contacts_between(from, [&](int n) { return at(after, n); })) {
    const auto point = point_of(pair, from);
    const double effective_inverse_mass = inverse_mass_of(*point, inverse_mass);
    if (!(effective_inverse_mass > 0)) continue;
    while (next != known.end() && next->pair < pair) ++next;
    const bool is_known = next != known.end() && next->pair == pair;
    const RememberedPair memory = is_known ? *next : RememberedPair{pair, {}, {}};
    const double allowed_gap = std::min(0.0, point->gap) * std::max(0.0, 1 - h / contact_recovery);
    const Vec3 drift = is_known ? memory.anchor.drift(*point, before, Vec3::Zero(), h) : Vec3::Zero();
    active_.push_back({memory, is_known, *point, (allowed_gap - point->gap) / h, effective_inverse_mass,
                       mobility_of(*point, inverse_mass), point->gap <= touching_gap, drift});
  }
}

template <class Real>
void SelfContactImpulses<Real>::begin_second_half(const std::vector<Real>& inverse_mass, const Real* x) {
  half_ = 1;
  is_warm_ = true;
  std::erase_if(active_, [](const ActiveContact& touch) { return !(touch.normal > 0); });
  for (ActiveContact& touch : active_) {
    if (const auto now = point_of(touch.memory.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    touch.inverse_mass = inverse_mass_of(touch.point, inverse_mass);
    touch.mobility = mobility_of(touch.point, inverse_mass);
    touch.min_gap_rate = touch.normal = touch.work = 0;
    touch.has_friction = true;
    touch.drift.setZero();
    touch.friction_impulse.setZero();
  }
  // A pair that met at a face's free corner may have slid to its fixed side, where nothing can move it.
  std::erase_if(active_, [](const ActiveContact& touch) { return !(touch.inverse_mass > 0); });
}

template <class Real>
void SelfContactImpulses<Real>::warm_start(Real* v) {
  // The rounds minimise the kinetic energy plus the impulses' work against the required velocities.
  double energy = 0;
  const auto start = [&](ActiveContact& touch) {
    const auto& last = touch.memory.halves[half_];
    if (!touch.is_known || touch.memory.anchor.idle > 0 || !(last.normal > 0)) return;
    const Vec3& n = touch.point.normal;
    const Vec3 u = velocity_of(touch.point, v);
    touch.normal = last.normal;
    if (touch.has_friction) touch.friction_impulse = last.friction - n.dot(last.friction) * n;
    const Vec3 impulse = touch.normal * n + touch.friction_impulse;
    energy += impulse.dot(u + impulse * (touch.inverse_mass / 2)) - touch.normal * touch.min_gap_rate +
              touch.friction_impulse.dot(touch.drift);
    touch.work = touch.friction_impulse.dot(u + touch.friction_impulse * (touch.inverse_mass / 2));
    add_impulse(touch.point, touch.mobility, impulse, v);
  };
  for (ActiveContact& touch : active_) start(touch);
  is_warm_ = energy <= 0;
  if (is_warm_) return;
  for (ActiveContact& touch : active_) {
    add_impulse(touch.point, touch.mobility, -touch.normal * touch.point.normal - touch.friction_impulse, v);
    touch.normal = touch.work = 0;
    touch.friction_impulse.setZero();
  }
}

template <class Real>
void SelfContactImpulses<Real>::solve(Real* v) {
  if (active_.empty()) return;
  for (int round = 1;; ++round) {
    double largest = 0, change = 0;
    bool is_cold = !is_warm_;
    for (ActiveContact& touch : active_) {
      change = std::max(change, solve_pair(touch, v));
      largest = std::max(largest, touch.normal);
      is_cold = is_cold || (touch.normal > 0 && !touch.is_known);
    }
    ++rounds_;
    residual_ = largest > 0 ? change / largest : 0;
    const Limit& limit = is_cold ? cold_limit : warm_limit;
    if (change <= limit.tolerance * largest || round >= limit.rounds) return;
  }
}

template <class Real>
void SelfContactImpulses<Real>::remember_first_half(const Real* x, std::vector<RememberedPair>& known) const {
  std::vector<RememberedPair> touched;
  for (const ActiveContact& touch : active_) {
    if (!(touch.normal > 0)) continue;
    RememberedPair& pair = touched.emplace_back(touch.memory);
    pair.halves[0] = {touch.normal, touch.friction_impulse};
    pair.anchor.update(touch.point, x, Vec3::Zero(), friction_, touch.normal, touch.friction_impulse.norm());
  }
  remember(known, touched);
}

template <class Real>
void SelfContactImpulses<Real>::remember_second_half(std::vector<RememberedPair>& known) const {
  auto next = known.begin();
  for (const ActiveContact& touch : active_) {  // each is known, since it got an impulse in the first half
    while (next->pair < touch.memory.pair) ++next;
    next->halves[1] = {touch.normal, touch.friction_impulse};
  }
}

/// Updates one pair's impulses. Returns their change, N s.
template <class Real>
double SelfContactImpulses<Real>::solve_pair(ActiveContact& touch, Real* v) const {
  const Vec3& n = touch.point.normal;
  const double closing = touch.min_gap_rate - n.dot(velocity_of(touch.point, v));
  if (touch.normal == 0 && !(closing > 0)) return 0;  // most pairs that touch at rest: others bear the load
  const double normal = std::max(0.0, touch.normal + closing / touch.inverse_mass);
  double change = std::abs(normal - touch.normal);
  if (change > 0) add_impulse(touch.point, touch.mobility, (normal - touch.normal) * n, v);
  touch.normal = normal;
  if (!(friction_ > 0) || !touch.has_friction || (!(normal > 0) && !(change > 0))) return change;
  const Vec3 u = velocity_of(touch.point, v);
  Vec3 friction_impulse = touch.friction_impulse - (u - n.dot(u) * n + touch.drift) / touch.inverse_mass;
  const double size = friction_impulse.norm(), max_friction = friction_ * normal;
  if (size > max_friction) friction_impulse *= max_friction / size;
  const Vec3 correction = friction_impulse - touch.friction_impulse;
  touch.friction_impulse = friction_impulse;
  if (!correction.isZero(0)) add_impulse(touch.point, touch.mobility, correction, v);
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
