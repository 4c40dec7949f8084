#include <algorithm>
#include <cmath>
#include <heml/tools/probe_impulses.hpp>

namespace heml {
namespace {

constexpr RoundLimit probe_cold{60, 1e-4};  // where a point is new
constexpr RoundLimit probe_warm{8, 1e-3};   // where all are of earlier steps
constexpr int max_searches = 8;             // for further points, in a step
constexpr double deep_enough = 1e-6;        // of the radius: less deep faces are outside
constexpr double near_enough = 0.25;        // of the radius: nodes may move by that until near faces are found again

/// The same point without nodes that have no weight, the others ascending.
ContactPoint on_feature(const ContactPoint& point) {
  ContactPoint same = point;
  same.count = 0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k) {
    if (point.weights[k] == 0) continue;
    auto i = static_cast<std::size_t>(same.count++);
    for (; i > 0 && same.nodes[i - 1] > point.nodes[k]; --i) {
      same.nodes[i] = same.nodes[i - 1];
      same.weights[i] = same.weights[i - 1];
    }
    same.nodes[i] = point.nodes[k];
    same.weights[i] = point.weights[k];
  }
  for (auto k = static_cast<std::size_t>(same.count); k < 4; ++k) {
    same.nodes[k] = same.nodes[k - 1];
    same.weights[k] = 0;
  }
  return same;
}

int nodes_of_feature(const std::array<double, 4>& weights) {
  return static_cast<int>(std::count_if(weights.begin(), weights.end(), [](double w) { return w != 0; }));
}

/// Gives a point the gap and the normal that it has at a place; returns whether the normal is certain, which it is not
/// near the axis.
bool place_at(const Vec3& place, const ContactSurface& capsule, ContactPoint& point) {
  const Vec3 axis = capsule.other - capsule.point;
  const double square = axis.squaredNorm();
  const double along = square > 0 ? std::clamp(axis.dot(place - capsule.point) / square, 0.0, 1.0) : 0;
  const Vec3 away = place - capsule.point - along * axis;
  const double distance = away.norm();
  if (!(distance > 0.5 * capsule.radius)) return false;
  point.gap = distance - capsule.radius;
  point.normal = away / distance;
  return true;
}

const AnchoredPoint* find(const std::vector<AnchoredPoint>& known, std::size_t surface,
                          const std::array<int, 4>& nodes) {
  const AnchoredPoint key{surface, nodes, {}};
  const auto place = std::lower_bound(known.begin(), known.end(), key);
  return place != known.end() && !(key < *place) ? &*place : nullptr;
}

}  // namespace

template <class Real>
void ProbeImpulses<Real>::clear(std::size_t node_count) {
  rows_.clear(node_count);
  touches_.clear();
  has_started_ = false;
  search_.nodes.clear();
}

/// All faces that may be inside the probe while nodes are where moved(node) tells. Impulses move nodes by little within
/// a step, so nearly always the first search of a step serves the others.
template <class Real>
template <class Moved>
const std::vector<Triangle>& ProbeImpulses<Real>::faces_near(const Check& check, const Moved& moved) {
  const std::vector<int>& nodes = check.boundary.nodes;
  const double margin = near_enough * check.now.radius;
  bool serves =
      search_.nodes.size() == nodes.size() && search_.tip == check.now.point && search_.other == check.now.other;
  for (std::size_t i = 0; i < nodes.size() && serves; ++i)
    serves = (moved(nodes[i]) - search_.nodes[i]).squaredNorm() <= margin * margin;
  if (serves) return search_.near;
  search_.tip = check.now.point;
  search_.other = check.now.other;
  search_.nodes.clear();
  for (const int n : nodes) search_.nodes.push_back(moved(n));
  search_.near.clear();
  for (const Triangle& face : check.boundary.faces)
    if (may_touch(check.now, moved(face[0]), moved(face[1]), moved(face[2]), margin)) search_.near.push_back(face);
  return search_.near;
}

/// Relates a row to the moving surface: it asks that the point is no slower along the normal, and slides otherwise.
template <class Real>
void ProbeImpulses<Real>::set_motion(const Touch& touch, double friction, const Vec3& drift,
                                     typename ContactRows<Real>::Row& row) const {
  const Vec3& n = touch.point.normal;
  row.min_gap_rate += n.dot(touch.velocity);
  row.drift = padded(drift - (touch.velocity - n.dot(touch.velocity) * n));
  row.friction = friction;
}

template <class Real>
void ProbeImpulses<Real>::start(const Check& check, const std::vector<AnchoredPoint>& known, Real* v) {
  has_started_ = true;
  if (!check.is_whole) return;
  const double h = check.duration;
  const Vec3 velocity = (check.now.point - check.then.point) / h;
  for (const AnchoredPoint& old : known) {
    if (old.surface != check.surface) continue;
    ContactPoint point{old.nodes, old.weights, nodes_of_feature(old.weights), 0, Vec3::Zero()};
    if (!place_at(at(check.before, point), check.then, point)) continue;
    const double effective_inverse_mass = inverse_mass_of(point, check.inverse_mass);
    if (!(effective_inverse_mass > 0)) continue;
    auto& row = rows_.add(point, effective_inverse_mass, check.inverse_mass);
    const Touch& touch = touches_.emplace_back(Touch{point, check.surface, velocity});
    const double allowed_gap = std::min(0.0, point.gap) * std::max(0.0, 1 - h / contact_recovery);
    row.min_gap_rate = (allowed_gap - point.gap) / h;
    row.is_known = true;
    set_motion(touch, check.now.friction, old.anchor.drift(point, check.before, check.then.point, h), row);
    if (old.anchor.idle == 0) start_with(old.halves[0], row);
  }
  rows_.start(v);
}

template <class Real>
void ProbeImpulses<Real>::stop(const Check& check, const std::vector<AnchoredPoint>& known, Real* v) {
  if (!has_started_) start(check, known, v);
  for (int search = 0; search < max_searches; ++search) {
    rows_.solve(probe_warm, probe_cold, v);
    if (!add_points(check, known, v)) return;
  }
  rows_.solve(probe_warm, probe_cold, v);
}

/// Adds a point for each face that would be inside the probe, or renews it where it was found before. Penetration at
/// the step's start decays over contact_recovery. Returns whether there was any.
template <class Real>
bool ProbeImpulses<Real>::add_points(const Check& check, const std::vector<AnchoredPoint>& known, Real* v) {
  const double h = check.duration;
  const auto moved = [&](int n) -> Vec3 { return at(check.before, n) + h * at(v, n); };
  const auto was = [&](int n) { return at(check.before, n); };
  std::vector<std::pair<ContactPoint, double>> inside;  // and the velocity that is missing, m/s
  each_capsule_contact(check.now, faces_near(check, moved), 0, moved, [&](const ContactPoint& point) {
    const double allowed_gap =
        std::min(0.0, updated_gap(check.then, point, was)) * std::max(0.0, 1 - h / contact_recovery);
    if (allowed_gap - point.gap > deep_enough * check.now.radius)
      inside.emplace_back(on_feature(point), (allowed_gap - point.gap) / h);
  });
  for (const auto& [point, closing] : inside) add(check, point, closing, known, v);
  return !inside.empty();
}

template <class Real>
void ProbeImpulses<Real>::add(const Check& check, const ContactPoint& point, double closing,
                              const std::vector<AnchoredPoint>& known, Real* v) {
  const double effective_inverse_mass = inverse_mass_of(point, check.inverse_mass);
  if (!(effective_inverse_mass > 0)) return;
  const auto same = [&](const Touch& touch) { return touch.point.nodes == point.nodes; };
  const auto i = static_cast<std::size_t>(std::find_if(touches_.begin(), touches_.end(), same) - touches_.begin());
  const Touch touch{point, check.surface, (check.now.point - check.then.point) / check.duration};
  const double rate = point.normal.dot(at(v, point) - touch.velocity);
  if (i == touches_.size()) {
    touches_.push_back(touch);
    rows_.add(point, effective_inverse_mass, check.inverse_mass);
  } else {
    touches_[i] = touch;
    rows_.turn(i, point, effective_inverse_mass, check.inverse_mass, v);
  }
  auto& row = rows_.rows()[i];
  row.min_gap_rate = rate + closing;
  const AnchoredPoint* anchored = find(known, check.surface, point.nodes);
  const Vec3 drift = anchored ? anchored->anchor.drift(point, check.before, check.then.point, check.duration)
                              : Vec3(Vec3::Zero());
  set_motion(touch, check.now.friction, drift, row);
}

template <class Real>
void ProbeImpulses<Real>::remember_first_half(const ContactSurface& now, std::size_t surface, const Real* x,
                                              const std::vector<AnchoredPoint>& known,
                                              std::vector<AnchoredPoint>& touched) const {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const ContactImpulse impulse = impulse_of(rows_.rows()[i]);
    if (!(impulse.normal > 0)) continue;
    const ContactPoint& point = touches_[i].point;
    const AnchoredPoint* old = find(known, surface, point.nodes);
    AnchoredPoint& point_now = touched.emplace_back(AnchoredPoint{surface, point.nodes, {}});
    if (old) point_now = *old;
    point_now.weights = point.weights;
    point_now.halves[0] = impulse;
    point_now.anchor.update(point, x, now.point, now.friction, impulse.normal, impulse.friction.norm());
  }
}

template <class Real>
void ProbeImpulses<Real>::begin_second_half(const ContactSurface& now, const std::vector<Real>& inverse_mass,
                                            const Real* x, const std::vector<AnchoredPoint>& known, Real* v) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const auto old = rows_.rows()[i];
    if (!(old.normal_impulse > 0)) continue;
    Touch touch = touches_[i];
    place_at(at(x, touch.point), now, touch.point);
    auto& row = rows_.replace(kept, touch.point, old.inverse_mass, inverse_mass);
    row.is_known = old.is_known;
    set_motion(touch, now.friction, Vec3::Zero(), row);
    const AnchoredPoint* same = find(known, touch.surface, touch.point.nodes);
    if (same && old.is_known && same->anchor.idle == 0) start_with(same->halves[1], row);
    touches_[kept++] = touch;
  }
  touches_.resize(kept);
  rows_.shrink_to(kept);
  rows_.start(v);
}

template <class Real>
void ProbeImpulses<Real>::solve(Real* v) {
  rows_.solve(probe_warm, probe_cold, v);
}

template <class Real>
void ProbeImpulses<Real>::remember_second_half(std::vector<AnchoredPoint>& known) const {
  for (std::size_t i = 0; i < touches_.size(); ++i) {
    const AnchoredPoint key{touches_[i].surface, touches_[i].point.nodes, {}};
    const auto place = std::lower_bound(known.begin(), known.end(), key);
    if (place != known.end() && !(key < *place)) place->halves[1] = impulse_of(rows_.rows()[i]);
  }
}

template class ProbeImpulses<float>;
template class ProbeImpulses<double>;

}  // namespace heml
