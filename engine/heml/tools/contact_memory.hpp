#pragma once
// What explicit contact carries from step to step: anchors of static friction, and the impulses with which the rounds
// of the next step start. Both change the bits of later steps, so whoever saves the state of a world saves this too.
//
//   sticks    the anchor stays; friction draws the point back to it, bounded by μ times the normal impulse
//   slides    the anchor follows the point
//   leaves    the anchor is forgotten after max_idle_steps without an impulse
//
// Contacts of a body at rest get unequal impulses from step to step, and some get none. So whether a point slides is
// judged by sums over some steps: in a single step it may slip a little, and the anchor brings it back.
#include <algorithm>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact.hpp>
#include <iterator>
#include <limits>

namespace heml {

inline constexpr int max_idle_steps = 16;

/// Where a contact point began to stick.
struct ContactAnchor {
  std::array<double, 4> weights{};  ///< of the point's nodes
  Vec3 place = Vec3::Zero();        ///< m, of the point, relative to the surface
  double normal = 0, friction = 0;  ///< N s, decaying sums of the impulses' magnitudes
  int idle = -1;                    ///< steps since the last impulse; −1: there was none

  /// Velocity (m/s) along the surface that would bring the point to the anchor over contact_recovery, negated.
  /// point: its nodes and normal. x: #V×3, m. origin: m, of the surface.
  template <class Real>
  Vec3 drift(const ContactPoint& point, const Real* x, const Vec3& origin, double h) const {
    ContactPoint anchored = point;
    anchored.weights = weights;
    const Vec3 moved = at(x, anchored) - origin - place;
    return (moved - point.normal.dot(moved) * point.normal) / std::max(h, contact_recovery);
  }

  /// Adds the impulses (N s) of a step that ended at x; where the point slid, the anchor follows it.
  template <class Real>
  void update(const ContactPoint& point, const Real* x, const Vec3& origin, double coefficient, double normal_impulse,
              double friction_impulse) {
    constexpr double decay = 0.9, sliding = 0.99;
    normal = decay * normal + normal_impulse;
    friction = decay * friction + friction_impulse;
    const bool is_new = idle < 0;
    idle = 0;
    if (!is_new && friction < sliding * coefficient * normal) return;
    weights = point.weights;
    place = at(x, point) - origin;
  }
};

/// Of one half of a step.
struct ContactImpulse {
  double normal = 0;             ///< N s
  Vec3 friction = Vec3::Zero();  ///< N s
};

/// A point of the body on a table or a probe.
struct AnchoredPoint {
  std::size_t surface;
  std::array<int, 4> nodes;
  ContactAnchor anchor;
  std::array<double, 4> weights{};         ///< of a probe's point, when it last touched
  std::array<ContactImpulse, 2> halves{};  ///< of a probe's point, in the last step's halves
};

inline bool operator<(const AnchoredPoint& a, const AnchoredPoint& b) {
  return std::tie(a.surface, a.nodes) < std::tie(b.surface, b.nodes);
}

/// A self-contact pair.
struct RememberedPair {
  ContactPair pair;
  ContactAnchor anchor;
  std::array<ContactImpulse, 2> halves{};  ///< of the last step's halves
};

inline bool operator<(const RememberedPair& a, const RememberedPair& b) { return a.pair < b.pair; }

struct ContactMemory {
  double time = -std::numeric_limits<double>::infinity();  ///< s, at which the state is that which it belongs to
  std::vector<AnchoredPoint> points;                       ///< ascending
  std::vector<RememberedPair> pairs;                       ///< ascending
};

/// Makes `known` the contacts that touched in this step and those that did so few steps ago. Both ascending.
template <class Contact>
void remember(std::vector<Contact>& known, const std::vector<Contact>& touched) {
  std::vector<Contact> idle;
  std::set_difference(known.begin(), known.end(), touched.begin(), touched.end(), std::back_inserter(idle));
  for (Contact& contact : idle) ++contact.anchor.idle;
  std::erase_if(idle, [](const Contact& contact) { return contact.anchor.idle > max_idle_steps; });
  known.clear();
  std::merge(idle.begin(), idle.end(), touched.begin(), touched.end(), std::back_inserter(known));
}

}  // namespace heml
