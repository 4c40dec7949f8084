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
constexpr Limit warm_limit{4, 1e-2};   // where all were there in earlier steps: the next step goes on from here

constexpr double touching_gap = 1e-7;  // m, largest gap at which friction acts

Eigen::Vector4d padded(const Vec3& x) { return {x[0], x[1], x[2], 0}; }

}  // namespace

/// The row of a pair that has no impulse yet. Its nodes join nodes_.
template <class Real>
auto SelfContactImpulses<Real>::row_of(const ContactPoint& point, double effective_inverse_mass,
                                       const std::vector<Real>& inverse_mass) -> Row {
  Row row;
  row.normal = padded(point.normal);
  row.drift.setZero();
  row.friction_impulse.setZero();
  row.weights = point.weights;
  for (std::size_t k = 0; k < 4; ++k) {
    const int n = point.nodes[k];
    row.mobility[k] = point.weights[k] * static_cast<double>(inverse_mass[index(n)]);
    int& local = local_[index(n)];
    if (local < 0) {
      local = static_cast<int>(nodes_.size());
      nodes_.push_back(n);
    }
    row.nodes[k] = local;
  }
  row.min_gap_rate = 0;
  row.inverse_mass = effective_inverse_mass;
  row.mass = 1 / effective_inverse_mass;
  row.has_friction = true;
  row.is_known = false;
  return row;
}

template <class Real>
void SelfContactImpulses<Real>::find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                           const Real* before, const Real* after,
                                           const std::vector<RememberedPair>& known) {
  friction_ = contact.friction();
  touches_.clear();
  rows_.clear();
  if (local_.size() != inverse_mass.size()) local_.assign(inverse_mass.size(), -1);
  for (const int n : nodes_)
    if (index(n) < local_.size()) local_[index(n)] = -1;
  nodes_.clear();
  half_ = 0;
  is_warm_ = true;
  rounds_ = 0;
  residual_ = 0;
  auto next = known.begin();
  const auto& pairs =
      contact.contacts_between([&](int n) { return at(before, n); }, [&](int n) { return at(after, n); });
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = pairs[i];
    const ContactPoint& point = contact.contact_points()[i];
    const double effective_inverse_mass = inverse_mass_of(point, inverse_mass);
    if (!(effective_inverse_mass > 0)) continue;
    Row& row = rows_.emplace_back(row_of(point, effective_inverse_mass, inverse_mass));
    Touch& touch = touches_.emplace_back(Touch{pair, point, -1, false, {}});
    const double allowed_gap = std::min(0.0, point.gap) * std::max(0.0, 1 - h / contact_recovery);
    row.min_gap_rate = (allowed_gap - point.gap) / h;
    row.has_friction = point.gap <= touching_gap;
    while (next != known.end() && next->pair < pair) ++next;
    if (next == known.end() || !(next->pair == pair)) continue;
    row.is_known = true;
    row.drift = padded(next->anchor.drift(point, before, Vec3::Zero(), h));
    touch.known = next - known.begin();
    touch.starts_warm = next->anchor.idle == 0;
    touch.last = next->halves;
  }
}

template <class Real>
void SelfContactImpulses<Real>::begin_second_half(const std::vector<Real>& inverse_mass, const Real* x) {
  half_ = 1;
  is_warm_ = true;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!(rows_[i].normal_impulse > 0)) continue;
    Touch& touch = touches_[i];
    if (const auto now = point_of(touch.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    const double effective_inverse_mass = inverse_mass_of(touch.point, inverse_mass);
    // A pair that met at a face's free corner may have slid to its fixed side, where nothing can move it.
    if (!(effective_inverse_mass > 0)) continue;
    const bool is_known = rows_[i].is_known;
    rows_[kept] = row_of(touch.point, effective_inverse_mass, inverse_mass);
    rows_[kept].is_known = is_known;
    if (kept < i) touches_[kept] = touch;
    ++kept;
  }
  rows_.erase(rows_.begin() + static_cast<std::ptrdiff_t>(kept), rows_.end());
  touches_.erase(touches_.begin() + static_cast<std::ptrdiff_t>(kept), touches_.end());
}

template <class Real>
void SelfContactImpulses<Real>::load(const Real* v) {
  velocities_.resize(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) velocities_[i] = padded(at(v, nodes_[i]));
}

template <class Real>
void SelfContactImpulses<Real>::store(Real* v) const {
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    Eigen::Map<Vector3<Real>>(v + 3 * nodes_[i]) = velocities_[i].template head<3>().template cast<Real>();
}

template <class Real>
auto SelfContactImpulses<Real>::velocity_of(const Row& row) const -> Vec4 {
  const auto v = [&](std::size_t k) -> const Vec4& { return velocities_[index(row.nodes[k])]; };
  const auto& w = row.weights;
  return (w[0] * v(0) + w[1] * v(1)) + (w[2] * v(2) + w[3] * v(3));
}

template <class Real>
void SelfContactImpulses<Real>::add_impulse(const Row& row, const Vec4& impulse) {
  for (std::size_t k = 0; k < 4; ++k) velocities_[index(row.nodes[k])] += row.mobility[k] * impulse;
}

template <class Real>
void SelfContactImpulses<Real>::warm_start(Real* v) {
  if (rows_.empty()) return;
  load(v);
  // The rounds minimise the kinetic energy plus the impulses' work against the required velocities.
  double energy = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& last = touches_[i].last[half_];
    if (!touches_[i].starts_warm || !(last.normal > 0)) continue;
    Row& row = rows_[i];
    const Vec4 u = velocity_of(row), friction = padded(last.friction);
    row.normal_impulse = last.normal;
    if (row.has_friction) row.friction_impulse = friction - row.normal.dot(friction) * row.normal;
    const Vec4 impulse = row.normal_impulse * row.normal + row.friction_impulse;
    energy += impulse.dot(u + impulse * (row.inverse_mass / 2)) - row.normal_impulse * row.min_gap_rate +
              row.friction_impulse.dot(row.drift);
    row.work = row.friction_impulse.dot(u + row.friction_impulse * (row.inverse_mass / 2));
    add_impulse(row, impulse);
  }
  is_warm_ = energy <= 0;
  if (is_warm_) return store(v);
  for (Row& row : rows_) {
    row.normal_impulse = row.work = 0;
    row.friction_impulse.setZero();
  }
}

template <class Real>
void SelfContactImpulses<Real>::solve(Real* v) {
  if (rows_.empty()) return;
  load(v);
  for (int round = 1;; ++round) {
    double largest = 0, change = 0;
    bool is_cold = !is_warm_;
    for (Row& row : rows_) {
      change = std::max(change, solve_pair(row));
      largest = std::max(largest, row.normal_impulse);
      is_cold = is_cold || (row.normal_impulse > 0 && !row.is_known);
    }
    ++rounds_;
    residual_ = largest > 0 ? change / largest : 0;
    const Limit& limit = is_cold ? cold_limit : warm_limit;
    if (change <= limit.tolerance * largest || round >= limit.rounds) break;
  }
  store(v);
}

template <class Real>
void SelfContactImpulses<Real>::remember_first_half(const Real* x, std::vector<RememberedPair>& known) const {
  std::vector<RememberedPair> fresh;
  for (RememberedPair& pair : known) ++pair.anchor.idle;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (!(row.normal_impulse > 0)) continue;
    const Touch& touch = touches_[i];
    RememberedPair& pair = touch.known < 0 ? fresh.emplace_back(RememberedPair{touch.pair, {}, {}})
                                           : known[static_cast<std::size_t>(touch.known)];
    pair.halves[0] = {row.normal_impulse, row.friction_impulse.template head<3>()};
    pair.anchor.update(touch.point, x, Vec3::Zero(), friction_, row.normal_impulse, row.friction_impulse.norm());
  }
  std::erase_if(known, [](const RememberedPair& pair) { return pair.anchor.idle > max_idle_steps; });
  const auto old = static_cast<std::ptrdiff_t>(known.size());
  known.insert(known.end(), fresh.begin(), fresh.end());
  std::inplace_merge(known.begin(), known.begin() + old, known.end());
}

template <class Real>
void SelfContactImpulses<Real>::remember_second_half(std::vector<RememberedPair>& known) const {
  auto next = known.begin();
  for (std::size_t i = 0; i < rows_.size(); ++i) {  // each is known, since it got an impulse in the first half
    while (next->pair < touches_[i].pair) ++next;
    next->halves[1] = {rows_[i].normal_impulse, rows_[i].friction_impulse.template head<3>()};
  }
}

/// Updates one pair's impulses. Returns their change, N s.
template <class Real>
double SelfContactImpulses<Real>::solve_pair(Row& row) {
  const Vec4 u = velocity_of(row);
  const double rate = row.normal.dot(u), closing = row.min_gap_rate - rate;
  if (row.normal_impulse == 0 && !(closing > 0)) return 0;  // most pairs that touch at rest: others bear the load
  const double normal = std::max(0.0, row.normal_impulse + closing * row.mass);
  const double added = normal - row.normal_impulse;
  double change = std::abs(added);
  row.normal_impulse = normal;
  if (!(friction_ > 0) || !row.has_friction) {
    add_impulse(row, added * row.normal);
    return change;
  }
  // The normal impulse leaves the velocity of sliding as it is.
  Vec4 friction_impulse = row.friction_impulse - (u - rate * row.normal + row.drift) * row.mass;
  const double square = friction_impulse.squaredNorm(), max_friction = friction_ * normal;
  if (square > max_friction * max_friction) friction_impulse *= max_friction / std::sqrt(square);
  const Vec4 correction = friction_impulse - row.friction_impulse;
  row.friction_impulse = friction_impulse;
  row.work += correction.dot(u + correction * (row.inverse_mass / 2));
  add_impulse(row, added * row.normal + correction);
  return std::max(change, correction.norm());
}

template <class Real>
void SelfContactImpulses<Real>::publish(double weight, double& normal_force, ContactReport& report) const {
  for (const Row& row : rows_) {
    normal_force += weight * row.normal_impulse;
    report.work += weight * row.work;
  }
}

template class SelfContactImpulses<float>;
template class SelfContactImpulses<double>;

}  // namespace heml
