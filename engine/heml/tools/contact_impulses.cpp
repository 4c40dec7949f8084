#include <algorithm>
#include <cmath>
#include <heml/tools/contact_impulses.hpp>
#include <heml/tools/contact_motion.hpp>

namespace heml {
namespace {

constexpr int turns = 3;            // of surfaces that may share nodes; self-contact and a probe iterate themselves
constexpr double max_travel = 0.5;  // of a probe's radius: distance between two checks along its path
constexpr double max_parts = 64;    // checks along the path within a step

}  // namespace

template <class Real>
struct ContactImpulses<Real>::StepPath {
  double from, to;  ///< s: the step's start, and the time within the step at which the surface is checked
  double weight;
  const std::vector<Real>& inverse_mass;
  const Real* before;
  std::vector<ContactSurface> then, now;  ///< at `from` and `to`
  bool repeats;                           ///< whether surfaces are visited several times, since they share nodes
};

template <class Real>
void ContactImpulses<Real>::begin_tick() {
  sums_ = {};
}

template <class Real>
void ContactImpulses<Real>::keep(const Contacts& contacts, Record& record) const {
  record.memory = memory_;
  record.sums = sums_;
  record.reports = contacts.reports;
}

template <class Real>
void ContactImpulses<Real>::restore(const Record& record, Contacts& contacts) {
  memory_ = record.memory;
  sums_ = record.sums;
  contacts.reports = record.reports;
}

template <class Real>
void ContactImpulses<Real>::list_nodes(std::vector<int>& nodes) const {
  nodes.assign(probe_.nodes().begin(), probe_.nodes().end());
  if (!tissue_.empty()) nodes.insert(nodes.end(), tissue_.nodes().begin(), tissue_.nodes().end());
  for (const Stopped& stopped : stopped_)
    nodes.insert(nodes.end(), stopped.point.nodes.begin(), stopped.point.nodes.begin() + stopped.point.count);
}

template <class Real>
void ContactImpulses<Real>::first_half_step(Contacts& contacts, double time_before, double time_after, double shrink,
                                            const std::vector<Real>& inverse_mass, const Real* before, Real* x,
                                            Real* v) {
  const double h = time_after - time_before;
  surfaces_ = contacts.surfaces(time_after);
  contacts.reports.resize(surfaces_.size());
  sums_.impulse.resize(contacts.reports.size(), Vec3::Zero());
  sums_.touching.resize(contacts.reports.size(), 0);
  sums_.duration += h;
  stopped_.clear();
  if (memory_.time != time_before) memory_ = {};
  memory_.time = time_after;
  double parts = 1;
  if (contacts.probe) {
    const double travel = (contacts.probe->tip(time_after) - contacts.probe->tip(time_before)).norm();
    parts = std::clamp(std::ceil(travel / (max_travel * contacts.probe->radius())), 1.0, max_parts);
  }
  if (contacts.tissue) {
    tissue_.find_pairs(*contacts.tissue, h, inverse_mass, before, x, memory_.pairs);
    tissue_.warm_start(v);
  }
  probe_.clear(inverse_mass.size());
  const int rounds = contacts.reports.size() > 1 ? turns : 1;
  for (double part = 1; part <= parts; ++part) {
    const double to = part < parts ? time_before + part / parts * h : time_after;
    const StepPath path{time_before,           to,        shrink, inverse_mass, before, contacts.surfaces(time_before),
                        contacts.surfaces(to), rounds > 1};
    for (int round = 0; round < rounds; ++round) {  // tables come last in a round, since they cannot move
      for (std::size_t s = contacts.reports.size(); s-- > 0;) {
        const auto shape = surfaces_[s].shape;
        if (shape == ContactSurface::Shape::capsule)
          probe_.stop({path.then[s], path.now[s], to - time_before, s, parts == 1, inverse_mass, contacts.boundary,
                       before},
                      memory_.points, v);
        else if (shape != ContactSurface::Shape::tissue)
          stop_points(path, s, contacts, v);
        else if (round == 0 || tissue_is_touched())
          tissue_.solve(v);
      }
      if (!takes_turns(contacts)) break;
    }
  }
  const auto place = [&](int n) {
    if (!(inverse_mass[static_cast<std::size_t>(n)] > 0)) return;
    for (int i = 3 * n; i < 3 * n + 3; ++i) x[i] = before[i] + static_cast<Real>(h) * v[i];
  };
  for (const Stopped& stopped : stopped_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(stopped.point.count); ++k) place(stopped.point.nodes[k]);
  for (const int n : probe_.nodes()) place(n);
  if (contacts.probe) report_probe(shrink, contacts, v);
  std::sort(stopped_.begin(), stopped_.end(), [](const Stopped& a, const Stopped& b) {
    return std::tie(a.surface, a.point.nodes) < std::tie(b.surface, b.point.nodes);
  });
  update_anchors(x);
  if (!contacts.tissue) return;
  for (const int n : tissue_.nodes()) place(n);
  tissue_.remember_first_half(x, memory_.pairs);
  tissue_.publish(shrink, sums_.normal_impulse, contacts.reports.back());
}

/// Whether another surface stopped a node of a self-contact pair, so that the two must be solved in turn.
template <class Real>
bool ContactImpulses<Real>::tissue_is_touched() const {
  const auto is_of_tissue = [this](int n) { return tissue_.has_node(n); };
  if (std::any_of(probe_.nodes().begin(), probe_.nodes().end(), is_of_tissue)) return true;
  return std::any_of(stopped_.begin(), stopped_.end(), [&](const Stopped& stopped) {
    const auto nodes = stopped.point.nodes.begin();
    return std::any_of(nodes, nodes + stopped.point.count, is_of_tissue);
  });
}

/// Whether contacts may share nodes, so that one round over all surfaces is not enough.
template <class Real>
bool ContactImpulses<Real>::takes_turns(const Contacts& contacts) const {
  return !contacts.tissue || contacts.probe || contacts.reports.size() > 2 || tissue_is_touched();
}

/// Stops points that would be inside surface s at path.to. Penetration at the step's start decays over
/// contact_recovery.
template <class Real>
void ContactImpulses<Real>::stop_points(const StepPath& path, std::size_t s, Contacts& contacts, Real* v) {
  const double h = path.to - path.from;
  const ContactSurface &now = path.now[s], &then = path.then[s];
  const auto moved = [&](int n) -> Vec3 { return at(path.before, n) + h * at(v, n); };
  const auto was = [&](int n) { return at(path.before, n); };
  each_contact(now, contacts.boundary, 0, moved, [&](const ContactPoint& point) {
    const double allowed_gap = std::min(0.0, updated_gap(then, point, was)) * std::max(0.0, 1 - h / contact_recovery);
    const double closing = (allowed_gap - point.gap) / h;
    if (closing > 0) push(stopped_at(path, s, point), point, closing, path.weight, path.inverse_mass, contacts, v);
  });
  if (!(now.friction > 0) || !path.repeats) return;
  for (Stopped& stopped : stopped_)
    if (stopped.surface == s) push(stopped, stopped.point, 0, path.weight, path.inverse_mass, contacts, v);
}

/// Adds the impulses of the probe in the last half to its report; v: #V×3, m/s, at the end of the half.
template <class Real>
void ContactImpulses<Real>::report_probe(double weight, Contacts& contacts, const Real* v) {
  const std::size_t s = probe_surface(contacts);
  int count = 0;
  probe_.each_impulse([&](const ContactPoint& point, const Vec3& impulse) {
    ++count;
    sums_.impulse[s] += weight * impulse;
    contacts.reports[s].work += weight * impulse.dot(at(v, point));
  });
  sums_.touching[s] = std::max(sums_.touching[s], count);
}

/// The record of a point on surface s in this step, made where there is none.
template <class Real>
auto ContactImpulses<Real>::stopped_at(const StepPath& path, std::size_t s, const ContactPoint& point) -> Stopped& {
  const auto comes_before = [&](const Stopped& a, const ContactPoint& b) {
    return a.surface != s ? a.surface > s : a.point.nodes < b.nodes;
  };
  const auto place = std::lower_bound(stopped_.begin(), stopped_.end(), point, comes_before);
  if (place != stopped_.end() && place->surface == s && place->point.nodes == point.nodes) return *place;
  const ContactSurface &now = path.now[s], &then = path.then[s];
  const double h = path.to - path.from;
  const Vec3 velocity = now.shape == ContactSurface::Shape::thread ? Vec3((then.radius - now.radius) / h * point.normal)
                                                                   : Vec3((now.point - then.point) / h);
  Stopped stopped{s, point, velocity, Vec3::Zero()};
  const AnchoredPoint key{s, point.nodes, {}};
  const auto known = std::lower_bound(memory_.points.begin(), memory_.points.end(), key);
  if (known != memory_.points.end() && !(key < *known))
    stopped.drift = known->anchor.drift(point, path.before, then.point, h);
  return *stopped_.insert(place, stopped);
}

/// Adds `closing` (m/s) along the normal to the velocity of a point and applies the friction impulse. weight: factor of
/// the impulse in the reported force and work.
template <class Real>
void ContactImpulses<Real>::push(Stopped& stopped, const ContactPoint& point, double closing, double weight,
                                 const std::vector<Real>& inverse_mass, Contacts& contacts, Real* v) {
  const double effective_inverse_mass = inverse_mass_of(point, inverse_mass);
  if (!(effective_inverse_mass > 0)) return;
  const double friction = surfaces_[stopped.surface].friction;
  const double p = closing / effective_inverse_mass;
  Vec3 impulse = p * point.normal;
  stopped.normal += p;
  if (friction > 0) {
    const Vec3 u = at(v, point) - stopped.velocity;
    // Velocity along the surface that friction would have to remove if it had not acted yet in this half.
    const Vec3 slides =
        u - point.normal.dot(u) * point.normal + stopped.drift - effective_inverse_mass * stopped.friction;
    const double speed = slides.norm();
    Vec3 total = Vec3::Zero();
    if (speed > 0) total = -(std::min(friction * stopped.normal, speed / effective_inverse_mass) / speed * slides);
    impulse += total - stopped.friction;
    stopped.friction = total;
  }
  apply_impulse(point, impulse, inverse_mass, v);
  sums_.impulse[stopped.surface] += weight * impulse;
  contacts.reports[stopped.surface].work += weight * impulse.dot(at(v, point));
}

/// Updates the anchors after the first half, which ended at x.
template <class Real>
void ContactImpulses<Real>::update_anchors(const Real* x) {
  std::vector<AnchoredPoint> touched;
  for (const Stopped& stopped : stopped_) {
    const ContactSurface& surface = surfaces_[stopped.surface];
    if (!(surface.friction > 0)) continue;
    AnchoredPoint& point = touched.emplace_back(AnchoredPoint{stopped.surface, stopped.point.nodes, {}});
    const auto known = std::lower_bound(memory_.points.begin(), memory_.points.end(), point);
    if (known != memory_.points.end() && !(point < *known)) point.anchor = known->anchor;
    point.anchor.update(stopped.point, x, surface.point, surface.friction, stopped.normal, stopped.friction.norm());
  }
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    if (surfaces_[s].shape == ContactSurface::Shape::capsule)
      probe_.remember_first_half(surfaces_[s], s, x, memory_.points, touched);
  std::sort(touched.begin(), touched.end());
  remember(memory_.points, touched);
}

template <class Real>
void ContactImpulses<Real>::second_half_step(Contacts& contacts, const std::vector<Real>& inverse_mass, const Real* x,
                                             Real* v) {
  if (contacts.tissue) {
    tissue_.begin_second_half(inverse_mass, x);
    tissue_.warm_start(v);
  }
  if (contacts.probe)
    probe_.begin_second_half(surfaces_[probe_surface(contacts)], inverse_mass, x, memory_.points, v);
  for (Stopped& stopped : stopped_) {
    stopped.normal = 0;
    stopped.friction.setZero();
    stopped.drift.setZero();
  }
  const bool repeats = surfaces_.size() > 1;
  const int rounds = repeats ? turns : 1;
  const bool touched = contacts.tissue && tissue_is_touched();
  for (int round = 0; round < rounds; ++round) {
    if (contacts.tissue && (round == 0 || touched)) tissue_.solve(v);
    probe_.solve(v);
    for (Stopped& stopped : stopped_) {
      const double inward = stopped.point.normal.dot(stopped.velocity - at(v, stopped.point));
      const bool may_stick = repeats && stopped.normal > 0 && surfaces_[stopped.surface].friction > 0;
      if (inward > 0 || may_stick) push(stopped, stopped.point, std::max(0.0, inward), 1, inverse_mass, contacts, v);
    }
    if (!takes_turns(contacts)) break;
  }
  if (contacts.probe) {
    probe_.remember_second_half(memory_.points);
    report_probe(1, contacts, v);
  }
  if (contacts.tissue) {
    tissue_.remember_second_half(memory_.pairs);
    tissue_.publish(1, sums_.normal_impulse, contacts.reports.back());
  }
  publish(contacts, x);
}

template <class Real>
void ContactImpulses<Real>::publish(Contacts& contacts, const Real* x) {
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    ContactReport& report = contacts.reports[s];
    report.force = sums_.impulse[s] / sums_.duration;
    report.energy = report.max_penetration = 0;
    report.contact_count = 0;
  }
  if (!tissue_.empty()) {
    ContactReport& report = contacts.reports.back();
    tissue_.each_contact_point([&](const ContactPoint& point) {
      ++report.contact_count;
      report.max_penetration = std::max(report.max_penetration, -point.gap);
    });
  }
  if (contacts.tissue) {
    contacts.reports.back().normal_force = sums_.normal_impulse / sums_.duration;
    contacts.reports.back().rounds = tissue_.rounds();
    contacts.reports.back().residual = tissue_.residual();
  }
  const auto count = [&](std::size_t s, const ContactPoint& point) {
    ContactReport& report = contacts.reports[s];
    ++report.contact_count;
    const double gap = updated_gap(surfaces_[s], point, [&](int n) { return at(x, n); });
    report.max_penetration = std::max(report.max_penetration, -gap);
  };
  for (const Stopped& stopped : stopped_) count(stopped.surface, stopped.point);
  probe_.each_impulse([&](const ContactPoint& point, const Vec3&) { count(probe_surface(contacts), point); });
  for (std::size_t s = 0; s < surfaces_.size(); ++s)  // impulses come and go within a tick
    sums_.touching[s] = contacts.reports[s].contact_count =
        std::max(sums_.touching[s], contacts.reports[s].contact_count);
}

template class ContactImpulses<float>;
template class ContactImpulses<double>;

}  // namespace heml
