#include <algorithm>
#include <cmath>
#include <heml/tools/contact_impulses.hpp>
#include <heml/tools/contact_motion.hpp>

namespace heml {
namespace {

constexpr int max_rounds = 8;       // of iteration over points that share nodes
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
};

template <class Real>
void ContactImpulses<Real>::begin_tick() {
  impulse_.clear();
  duration_ = normal_impulse_ = 0;
}

template <class Real>
void ContactImpulses<Real>::first_half_step(Contacts& contacts, double time_before, double time_after, double shrink,
                                            const std::vector<Real>& inverse_mass, const Real* before, Real* x,
                                            Real* v) {
  const double h = time_after - time_before;
  surfaces_ = contacts.surfaces(time_after);
  contacts.reports.resize(surfaces_.size());
  impulse_.resize(contacts.reports.size(), Vec3::Zero());
  duration_ += h;
  stopped_.clear();
  double parts = 1;
  if (contacts.probe) {
    const double travel = (contacts.probe->tip(time_after) - contacts.probe->tip(time_before)).norm();
    parts = std::clamp(std::ceil(travel / (max_travel * contacts.probe->radius())), 1.0, max_parts);
  }
  if (contacts.tissue) tissue_.find_pairs(*contacts.tissue, h, inverse_mass, before, x);
  const int rounds = contacts.reports.size() > 1 ? 3 : 1;
  for (double part = 1; part <= parts; ++part) {
    const double to = part < parts ? time_before + part / parts * h : time_after;
    const StepPath path{time_before,          to, shrink, inverse_mass, before, contacts.surfaces(time_before),
                        contacts.surfaces(to)};
    for (int round = 0; round < rounds; ++round)  // tables come last in a round, since they cannot move
      for (std::size_t s = contacts.reports.size(); s-- > 0;) {
        if (surfaces_[s].shape == ContactSurface::Shape::tissue)
          tissue_.solve(inverse_mass, v);
        else
          stop_points(path, s, contacts, v);
      }
  }
  const auto less = [](const Stopped& a, const Stopped& b) {
    return a.surface != b.surface ? a.surface < b.surface : a.point.nodes < b.point.nodes;
  };
  std::stable_sort(stopped_.begin(), stopped_.end(), less);
  stopped_.erase(std::unique(stopped_.begin(), stopped_.end(),
                             [&](const Stopped& a, const Stopped& b) { return !less(a, b) && !less(b, a); }),
                 stopped_.end());
  const auto place = [&](int n) {
    if (!(inverse_mass[static_cast<std::size_t>(n)] > 0)) return;
    for (int i = 3 * n; i < 3 * n + 3; ++i) x[i] = before[i] + static_cast<Real>(h) * v[i];
  };
  for (const Stopped& stopped : stopped_)
    for (std::size_t k = 0; k < static_cast<std::size_t>(stopped.point.count); ++k) place(stopped.point.nodes[k]);
  if (!contacts.tissue) return;
  tissue_.each_node(place);
  tissue_.publish(shrink, normal_impulse_, contacts.reports.back());
}

/// Stops points that would be inside surface s at path.to. Penetration at the step's start decays over
/// contact_recovery.
template <class Real>
void ContactImpulses<Real>::stop_points(const StepPath& path, std::size_t s, Contacts& contacts, Real* v) {
  const double h = path.to - path.from;
  const ContactSurface &now = path.now[s], &then = path.then[s];
  const auto moved = [&](int n) -> Vec3 { return at(path.before, n) + h * at(v, n); };
  const auto was = [&](int n) { return at(path.before, n); };
  const bool is_thread = now.shape == ContactSurface::Shape::thread,
             is_capsule = now.shape == ContactSurface::Shape::capsule;
  bool deep = true;
  for (int round = 0; deep && round < (is_capsule ? max_rounds : 1); ++round) {
    deep = false;
    each_contact(now, contacts.boundary, 0, moved, [&](const ContactPoint& point) {
      const double allowed_gap = std::min(0.0, updated_gap(then, point, was)) * std::max(0.0, 1 - h / contact_recovery);
      const double closing = (allowed_gap - point.gap) / h;
      if (!(closing > 0)) return;
      const Vec3 velocity =
          is_thread ? Vec3((then.radius - now.radius) / h * point.normal) : Vec3((now.point - then.point) / h);
      stopped_.push_back({s, point, velocity});
      push(stopped_.back(), closing, path.weight, path.inverse_mass, contacts, v);
      deep = deep || allowed_gap - point.gap > 1e-6 * now.radius;
    });
  }
}

/// Adds `closing` (m/s) along the normal to a point's velocity and applies the friction impulse. weight: factor of the
/// impulse in the reported force and work.
template <class Real>
void ContactImpulses<Real>::push(const Stopped& stopped, double closing, double weight,
                                 const std::vector<Real>& inverse_mass, Contacts& contacts, Real* v) {
  const ContactPoint& point = stopped.point;
  const double effective_inverse_mass = inverse_mass_of(point, inverse_mass);
  if (!(effective_inverse_mass > 0)) return;
  const double friction = surfaces_[stopped.surface].friction;
  const Vec3 u = at(v, point) - stopped.velocity, slides = u - point.normal.dot(u) * point.normal;
  const double p = closing / effective_inverse_mass, speed = slides.norm();
  Vec3 impulse = p * point.normal;
  if (speed > 0 && friction > 0) impulse -= std::min(friction * p, speed / effective_inverse_mass) / speed * slides;
  apply_impulse(point, impulse, inverse_mass, v);
  impulse_[stopped.surface] += weight * impulse;
  contacts.reports[stopped.surface].work += weight * impulse.dot(at(v, point));
}

template <class Real>
void ContactImpulses<Real>::second_half_step(Contacts& contacts, const std::vector<Real>& inverse_mass, const Real* x,
                                             Real* v) {
  if (contacts.tissue) tissue_.begin_second_half(inverse_mass, x);
  for (int round = 0; round < (surfaces_.size() > 1 || contacts.probe ? max_rounds : 1); ++round) {
    if (contacts.tissue) tissue_.solve(inverse_mass, v);
    for (const Stopped& stopped : stopped_) {
      const double inward = stopped.point.normal.dot(stopped.velocity - at(v, stopped.point));
      if (inward > 0) push(stopped, inward, 1, inverse_mass, contacts, v);
    }
  }
  if (contacts.tissue) tissue_.publish(1, normal_impulse_, contacts.reports.back());
  publish(contacts, x);
}

template <class Real>
void ContactImpulses<Real>::publish(Contacts& contacts, const Real* x) const {
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    ContactReport& report = contacts.reports[s];
    report.force = impulse_[s] / duration_;
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
  if (contacts.tissue) contacts.reports.back().normal_force = normal_impulse_ / duration_;
  for (const Stopped& stopped : stopped_) {
    ContactReport& report = contacts.reports[stopped.surface];
    ++report.contact_count;
    const double gap = updated_gap(surfaces_[stopped.surface], stopped.point, [&](int n) { return at(x, n); });
    report.max_penetration = std::max(report.max_penetration, -gap);
  }
}

template class ContactImpulses<float>;
template class ContactImpulses<double>;

}  // namespace heml
