#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <heml/tools/contact_potential.hpp>
#include <limits>

namespace heml {
namespace {

constexpr int max_revisions = 16;        // of one solve
constexpr double nearest_axis = 0.25;    // of a probe's radius: tissue nearer to the axis counts as passing through
constexpr double stiffest_spring = 1e6;  // times a node's own stiffness
constexpr double share_of_node = 0.5;    // of a node's stiffness, for each face round it
constexpr double slip_distance = 0.1;    // of the accepted penetration: how far tissue moves at least before it slips
constexpr double same_friction = 1e-3;   // of the sum of friction bounds: accepted change

Vec3 at(const Vector& x, int node) { return x.segment<3>(3 * node); }

Vec3 at(const Vector& x, const ContactPoint& point) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
    sum += point.weights[k] * at(x, point.nodes[k]);
  return sum;
}

void add(const ContactPoint& point, const Vec3& force, Vector& f) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(point.count); ++k)
    f.segment<3>(3 * point.nodes[k]) += point.weights[k] * force;
}

Mat3 tangent_projector(const Vec3& normal) { return Mat3::Identity() - normal * normal.transpose(); }

}  // namespace

void ContactPotential::begin(const Vector& x, double time) {
  const bool first = stiffness_factor_.empty();
  surfaces_before_ = surfaces_ = contacts_.surfaces(time);
  stiffness_factor_.resize(surfaces_.size(), 1);
  contacts_.reports.resize(surfaces_.size());
  x_before_ = x_seen_ = x;
  touches_at_.resize(0);
  revisions_ = 0;
  pairs_.clear();
  add_touching_pairs(x);
  if (first) {  // initial contacts stick until their normal force is known, but for tissue: the faces of a cut part
    find(x);
    for (const ActiveContact& touch : active_)
      if (surfaces_[touch.surface].friction > 0 && surfaces_[touch.surface].shape != ContactSurface::Shape::tissue)
        accepted_.push_back({touch, std::numeric_limits<double>::infinity(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    touches_at_.resize(0);
  }
  friction_ = accepted_;
  step_taken_ = 0;
}

void ContactPotential::reset() {
  stiffness_factor_.clear();
  friction_.clear();
  accepted_.clear();
  surfaces_.clear();
  pairs_.clear();
  bearing_.clear();
  seen_.clear();
  touches_at_.resize(0);
}

void ContactPotential::set_time(double time) {
  if (stiffness_factor_.empty()) return;  // no step has begun
  friction_ = accepted_;
  step_taken_ = 0;
  surfaces_ = contacts_.surfaces(time);
  touches_at_.resize(0);
  revisions_ = 0;
}

void ContactPotential::find(const Vector& x) {
  if (touches_at_.size() > 0 && touches_at_ == x) return;
  active_.clear();
  const auto where = [&](int n) { return at(x, n); };
  const double near = 1e-9 * bound_;
  for (std::size_t s = 0; s < surfaces_.size(); ++s) {
    if (surfaces_[s].shape != ContactSurface::Shape::tissue) {
      each_contact(surfaces_[s], contacts_.boundary, near, where, [&](const ContactPoint& point) {
        active_.push_back({s, point, 0});
      });
      continue;
    }
    for (const ContactPair& pair : pairs_)
      if (const auto point = point_of(pair, where); point && point->gap < near)
        active_.push_back({s, *point, pair.side});
  }
  touches_at_ = x;
}

void ContactPotential::expect(const Vector& x) { add_touching_pairs(x); }

/// Adds to pairs_ those that touch on the way to x. Returns whether a new pair penetrates at x by more than the bound.
bool ContactPotential::add_touching_pairs(const Vector& x) {
  if (!contacts_.tissue || !with_tissue_) return false;
  const auto before = [&](int n) { return at(x_before_, n); };
  const auto now = [&](int n) { return at(x, n); };
  const auto& met = contacts_.tissue->contacts_between(before, now, bearing_);
  std::vector<ContactPair> added, all;
  std::set_difference(met.begin(), met.end(), pairs_.begin(), pairs_.end(), std::back_inserter(added));
  const bool inside = std::any_of(added.begin(), added.end(), [&](const ContactPair& pair) {
    const auto point = point_of(pair, now);
    return point && point->gap < -bound_;
  });
  std::merge(pairs_.begin(), pairs_.end(), added.begin(), added.end(), std::back_inserter(all));
  pairs_ = std::move(all);
  touches_at_.resize(0);
  return inside;
}

double ContactPotential::stiffness_of(const ContactPoint& point) const {
  const auto k = [&](std::size_t c) { return stiffness_[static_cast<std::size_t>(point.nodes[c])]; };
  if (point.count == 1) return k(0);
  if (point.count == 2) return (k(0) + k(1)) / 2;
  return share_of_node * (point.count == 3 ? (k(0) + k(1) + k(2)) / 3 : (k(0) + k(1) + k(2) + k(3)) / 4);
}

double ContactPotential::normal_stiffness(const ActiveContact& touch) const {
  return stiffness_factor_[touch.surface] * stiffness_of(touch.point);
}

/// That of the nodes, or less where a light contact would slip within a distance that is nothing to a solver, so that
/// its force would jump.
double ContactPotential::friction_stiffness(const Friction& friction) const {
  return std::min(stiffness_of(friction.touch.point), friction.max_force / (slip_distance * bound_));
}

/// Stretch of a point's friction spring, m.
Vec3 ContactPotential::sliding(const Friction& friction, const Vector& x) const {
  const ContactPoint& point = friction.touch.point;
  const std::size_t surface = friction.touch.surface;
  const Vec3 displacement =
      at(x, point) - at(x_before_, point) - (surfaces_[surface].point - surfaces_before_[surface].point);
  return tangent_projector(point.normal) * (displacement + friction.stretch);
}

Vec3 ContactPotential::friction_force(const Friction& friction, const Vector& x) const {
  const Vec3 slid = sliding(friction, x);
  const double k = friction_stiffness(friction), length = slid.norm();
  if (k * length <= friction.max_force) return -k * slid;
  return -friction.max_force / length * slid;
}

bool ContactPotential::crosses_probe(const Vector& x) const {
  if (!contacts_.probe || x_seen_.size() != x.size()) return false;
  double displacement = 0;
  for (const int n : contacts_.boundary.nodes)
    displacement = std::max(displacement, (at(x, n) - at(x_seen_, n)).norm());
  bool passed = false;
  for (const ContactSurface& surface : surfaces_) {
    if (surface.shape != ContactSurface::Shape::capsule || displacement < nearest_axis * surface.radius) continue;
    each_contact(
        surface, contacts_.boundary, displacement, [&](int n) { return at(x_seen_, n); },
        [&](const ContactPoint& point) {
          const Vec3 moved = at(x, point) - at(x_seen_, point);
          const double from_axis = surface.radius + point.gap + point.normal.dot(moved);
          passed = passed || (from_axis < nearest_axis * surface.radius && point.normal.dot(moved) < 0);
        });
  }
  return passed;
}

double ContactPotential::value(const Vector& x) {
  find(x);
  double sum = 0;
  for (const ActiveContact& touch : active_) {
    const double inside = std::min(0.0, touch.point.gap);
    sum += normal_stiffness(touch) / 2 * inside * inside;
  }
  for (const Friction& friction : friction_) {
    const double k = friction_stiffness(friction), slid = sliding(friction, x).norm();
    sum += k * slid <= friction.max_force ? k / 2 * slid * slid
                                          : friction.max_force * (slid - friction.max_force / (2 * k));
  }
  return sum;
}

void ContactPotential::add_forces(const Vector& x, Vector& f) {
  find(x);
  for (const ActiveContact& touch : active_)
    add(touch.point, -normal_stiffness(touch) * std::min(0.0, touch.point.gap) * touch.point.normal, f);
  for (const Friction& friction : friction_) add(friction.touch.point, friction_force(friction, x), f);
}

/// Follows the duals to x, by the linear model of the last linearise() (Chan, Golub, Mulet 1999): what is linearised is
/// not force = f s/|s| but |s| force = f s.
void ContactPotential::update_duals(const Vector& x) {
  for (Friction& friction : friction_) {
    const Vec3 slid = sliding(friction, x), moved = slid - friction.slid;
    const double k = friction_stiffness(friction), length = friction.slid.norm();
    if (step_taken_ > 0 && k > 0) {
      if (k * length <= friction.max_force)
        friction.dual += k * moved + step_taken_ * (k * friction.slid - friction.dual);
      else
        friction.dual += (friction.max_force * moved - friction.dual * friction.slid.dot(moved) / length) / length +
                         step_taken_ * (friction.max_force / length * friction.slid - friction.dual);
    }
    if (const double size = friction.dual.norm(); size > friction.max_force) friction.dual *= friction.max_force / size;
    friction.slid = slid;
  }
  step_taken_ = 0;
}

/// Whether the faces and pairs in contact are those of the last call. Newton's method has then come near enough for
/// what they do in second order; before, it would meet negative curvature that a solution has not.
bool ContactPotential::is_settled() {
  std::vector<std::array<int, 4>> now;
  for (const ActiveContact& touch : active_)
    if (touch.point.count >= 3) now.push_back(touch.point.nodes);
  std::swap(now, seen_);
  return now == seen_;
}

void ContactPotential::linearise(const Vector& x, bool positive) {
  find(x);
  x_seen_ = x;
  blocks_.clear();
  slides_.clear();
  const bool has_slides = !positive && is_settled();
  for (const ActiveContact& touch : active_) {
    const Vec3& n = touch.point.normal;
    const double k = normal_stiffness(touch), force = -k * std::min(0.0, touch.point.gap);
    Mat3 K = k * n * n.transpose();
    if (touch.point.count == 2)  // geometric stiffness of a taut thread
      K += force / at(x, touch.point).norm() * tangent_projector(n);
    blocks_.push_back({touch.point, K});
    const auto& nodes = touch.point.nodes;
    if (touch.point.count == 3)
      add_face_slides(surfaces_[touch.surface], touch.point, {at(x, nodes[0]), at(x, nodes[1]), at(x, nodes[2])}, force,
                      slides_);
    if (touch.point.count == 4 && has_slides)
      add_pair_slides(touch.side, touch.point, {at(x, nodes[0]), at(x, nodes[1]), at(x, nodes[2]), at(x, nodes[3])},
                      force, slides_);
  }
  if (!has_slides) std::erase_if(slides_, [](const RankOneTerm& slide) { return slide.sign < 0; });
  update_duals(x);
  for (const Friction& friction : friction_) {
    const double k = friction_stiffness(friction);
    if (!(k > 0)) continue;
    const Vec3 slid = sliding(friction, x);
    const double length = slid.norm();
    const Mat3 plane = tangent_projector(friction.touch.point.normal);
    if (k * length <= friction.max_force) {
      blocks_.push_back({friction.touch.point, k * plane});
    } else {
      const Mat3 turned = friction.dual * slid.transpose() / length;
      blocks_.push_back(
          {friction.touch.point, (friction.max_force * plane - (turned + turned.transpose()) / 2) / length});
    }
  }
}

void ContactPotential::add_product(const Vector& dx, Vector& out) const {
  for (const auto& [point, K] : blocks_) add(point, K * at(dx, point), out);
  for (const RankOneTerm& slide : slides_) {
    const auto count = static_cast<std::size_t>(slide.count);
    double along = 0;
    for (std::size_t k = 0; k < count; ++k) along += slide.g[k].dot(at(dx, slide.nodes[k]));
    for (std::size_t k = 0; k < count; ++k) out.segment<3>(3 * slide.nodes[k]) += slide.sign * along * slide.g[k];
  }
}

void ContactPotential::add_coupled_pairs(std::vector<std::array<int, 2>>& pairs) const {
  for (const auto& [point, K] : blocks_)
    if (point.count != 3)  // else the corners of a face
      for (std::size_t a = 0; a < static_cast<std::size_t>(point.count); ++a)
        for (std::size_t b = 0; b < a; ++b) pairs.push_back({point.nodes[a], point.nodes[b]});
}

void ContactPotential::add_rank_one_terms(std::vector<RankOneTerm>& terms) const {
  for (const auto& [point, K] : blocks_) {
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(K);
    for (int k = 0; k < 3; ++k) {
      const double value = eigen.eigenvalues()[k];
      if (!(value > 1e-9 * eigen.eigenvalues()[2])) continue;
      std::array<Vec3, 4> g;
      for (std::size_t a = 0; a < g.size(); ++a) {
        const double weight = a < static_cast<std::size_t>(point.count) ? point.weights[a] : 0;
        g[a] = weight * std::sqrt(value) * eigen.eigenvectors().col(k);
      }
      terms.push_back({point.count, point.nodes, g});
    }
  }
  terms.insert(terms.end(), slides_.begin(), slides_.end());
}

/// Friction of the active contacts, bounded by the normal forces at x. Springs that exist keep their stretch.
std::vector<ContactPotential::Friction> ContactPotential::friction_of_touches() const {
  std::vector<Friction> result;
  std::size_t old = 0;  // both lists are ordered by surface, then as each_contact() visits
  for (const ActiveContact& touch : active_) {
    const double friction = surfaces_[touch.surface].friction;
    if (!(friction > 0) || !(touch.point.gap < 0)) continue;
    Friction& now = result.emplace_back(Friction{touch, -friction * normal_stiffness(touch) * touch.point.gap,
                                                 Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    const auto is_same = [&](const Friction& f) {
      return f.touch.surface == touch.surface && f.touch.point.nodes == touch.point.nodes;
    };
    for (std::size_t k = 0; k < friction_.size(); ++k, ++old) {
      if (old >= friction_.size()) old = 0;
      if (!is_same(friction_[old])) continue;
      now.stretch = friction_[old].stretch;
      now.dual = friction_[old].dual;
      now.slid = friction_[old].slid;
      break;
    }
  }
  return result;
}

bool ContactPotential::update_lagged(const Vector& x) {
  if (empty() || ++revisions_ > max_revisions) return false;
  update_duals(x);
  // Of the points that were resisted, with the penalty that resisted them: what a new pair goes through says nothing
  // about forces or penalty.
  find(x);
  std::vector<double> max_penetration(surfaces_.size(), 0.0);
  for (const ActiveContact& touch : active_)
    max_penetration[touch.surface] = std::max(max_penetration[touch.surface], -touch.point.gap);
  std::vector<Friction> now = friction_of_touches();
  bool changes = add_touching_pairs(x);
  find(x);
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    if (max_penetration[s] > bound_ && stiffness_factor_[s] < stiffest_spring) {
      stiffness_factor_[s] *= std::clamp(2 * max_penetration[s] / bound_, 2.0, 32.0);
      changes = true;
    }
  double sum = 0, difference = 0;
  for (const Friction& friction : now) sum += friction.max_force;
  const bool same_points =
      now.size() == friction_.size() &&
      std::equal(now.begin(), now.end(), friction_.begin(), [](const Friction& a, const Friction& b) {
        return a.touch.surface == b.touch.surface && a.touch.point.nodes == b.touch.point.nodes;
      });
  if (same_points)
    for (std::size_t k = 0; k < now.size(); ++k) difference += std::abs(now[k].max_force - friction_[k].max_force);
  if (!now.empty() || !friction_.empty())
    if (!same_points || !(difference <= same_friction * sum)) {
      friction_ = std::move(now);
      changes = true;
    }
  return changes;
}

void ContactPotential::accept(const Vector& x) {
  if (empty()) return;
  find(x);
  update_duals(x);
  for (ContactReport& report : contacts_.reports) {
    report.force.setZero();
    report.normal_force = report.energy = report.max_penetration = 0;
    report.contact_count = 0;
  }
  const auto publish = [&](const ActiveContact& touch, const Vec3& force) {
    ContactReport& report = contacts_.reports[touch.surface];
    report.force += force;
    report.work += force.dot(at(x, touch.point) - at(x_before_, touch.point));
  };
  for (const ActiveContact& touch : active_) {
    const double inside = std::min(0.0, touch.point.gap), k = normal_stiffness(touch);
    ContactReport& report = contacts_.reports[touch.surface];
    publish(touch, -k * inside * touch.point.normal);
    if (touch.point.count == 4) report.normal_force -= k * inside;
    report.energy += k / 2 * inside * inside;
    report.max_penetration = std::max(report.max_penetration, -inside);
    report.contact_count += inside < 0 ? 1 : 0;
  }
  for (Friction& friction : friction_) {
    const Vec3 force = friction_force(friction, x);
    publish(friction.touch, force);
    // A slipping spring keeps the stretch that its force explains. Closest points of faces move along a probe, so their
    // springs restart at zero.
    const double k = friction_stiffness(friction);
    const bool stays = friction.touch.point.count == 1 || friction.touch.point.count == 4;
    friction.stretch = stays && k > 0 ? Vec3(-force / k) : Vec3(Vec3::Zero());
  }
  accepted_ = friction_of_touches();
  bearing_.clear();
  for (const ContactPair& pair : pairs_)
    if (const auto point = point_of(pair, [&](int n) { return at(x, n); }); point && point->gap < 0)
      bearing_.push_back(pair);
}

}  // namespace heml
