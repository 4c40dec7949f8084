#include <algorithm>
#include <cmath>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact_impulses.hpp>

namespace heml {
namespace {

constexpr RoundLimit cold_limit{60, 1e-8};  // where a pair is new
constexpr RoundLimit warm_limit{4, 1e-3};   // where all were there in earlier steps: the next step goes on from here,
                                            // but a hundredth left over shakes bodies at rest with friction

constexpr double touching_gap = 1e-7;  // m, largest gap at which friction acts

}  // namespace

template <class Real>
void SelfContactImpulses<Real>::find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass,
                                           const Real* before, const Real* after,
                                           const std::vector<RememberedPair>& known) {
  friction_ = contact.friction();
  touches_.clear();
  rows_.clear(inverse_mass.size());
  held_.clear();  // edges alone: explicit steps are short, and a node beside its face soon meets the next one
  for (const RememberedPair& pair : known)
    if (pair.anchor.idle == 0 && pair.pair.side != 0) held_.push_back(pair.pair);
  auto next = known.begin();
  const auto& pairs =
      contact.contacts_between([&](int n) { return at(before, n); }, [&](int n) { return at(after, n); }, held_);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactPair& pair = pairs[i];
    const ContactPoint& point = contact.contact_points()[i];
    const double effective_inverse_mass = inverse_mass_of(point, inverse_mass);
    if (!(effective_inverse_mass > 0)) continue;
    auto& row = rows_.add(point, effective_inverse_mass, inverse_mass);
    Touch& touch = touches_.emplace_back(Touch{pair, point, -1, {}});
    const double kept = pair.side != 0 ? contact.hidden_depth() : 0;
    const double recovered = std::max(0.0, -kept - point.gap) * std::min(1.0, h / contact_recovery);
    row.min_gap_rate = (recovered - std::max(0.0, point.gap)) / h;
    row.friction = point.gap <= touching_gap ? friction_ : 0;
    while (next != known.end() && next->pair < pair) ++next;
    if (next == known.end() || !(next->pair == pair)) continue;
    row.is_known = true;
    row.drift = padded(next->anchor.drift(point, before, Vec3::Zero(), h));
    touch.known = next - known.begin();
    if (next->anchor.idle == 0) touch.last = next->halves;
    start_with(touch.last[0], row);
  }
}

template <class Real>
void SelfContactImpulses<Real>::begin_second_half(const std::vector<Real>& inverse_mass, const Real* x) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    if (!(rows_.rows()[i].normal_impulse > 0)) continue;
    Touch& touch = touches_[i];
    if (const auto now = point_of(touch.pair, [&](int n) { return at(x, n); })) touch.point = *now;
    const double effective_inverse_mass = inverse_mass_of(touch.point, inverse_mass);
    // A pair that met at a face's free corner may have slid to its fixed side, where nothing can move it.
    if (!(effective_inverse_mass > 0)) continue;
    const bool is_known = rows_.rows()[i].is_known;
    auto& row = rows_.replace(kept, touch.point, effective_inverse_mass, inverse_mass);
    row.is_known = is_known;
    row.friction = friction_;
    start_with(touch.last[1], row);
    if (kept < i) touches_[kept] = touch;
    ++kept;
  }
  rows_.shrink_to(kept);
  touches_.erase(touches_.begin() + static_cast<std::ptrdiff_t>(kept), touches_.end());
}

template <class Real>
void SelfContactImpulses<Real>::solve(Real* v) {
  rows_.solve(warm_limit, cold_limit, v);
}

template <class Real>
void SelfContactImpulses<Real>::remember_first_half(const Real* x, std::vector<RememberedPair>& known) const {
  std::vector<RememberedPair> fresh;
  for (RememberedPair& pair : known) ++pair.anchor.idle;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const auto& row = rows_.rows()[i];
    if (!(row.normal_impulse > 0)) continue;
    const Touch& touch = touches_[i];
    RememberedPair& pair = touch.known < 0 ? fresh.emplace_back(RememberedPair{touch.pair, {}, {}})
                                           : known[static_cast<std::size_t>(touch.known)];
    pair.halves[0] = impulse_of(row);
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
  for (std::size_t i = 0; i < touches_.size(); ++i) {  // each is known, since it got an impulse in the first half
    while (next->pair < touches_[i].pair) ++next;
    next->halves[1] = impulse_of(rows_.rows()[i]);
  }
}

template <class Real>
void SelfContactImpulses<Real>::publish(double weight, double& normal_force, ContactReport& report) const {
  for (const auto& row : rows_.rows()) {
    normal_force += weight * row.normal_impulse;
    report.work += weight * row.work;
  }
}

template class SelfContactImpulses<float>;
template class SelfContactImpulses<double>;

}  // namespace heml
