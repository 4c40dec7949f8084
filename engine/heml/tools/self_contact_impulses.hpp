#pragma once
// Self-contact in explicit steps. Unlike a node on a table (contact_impulses.hpp), pairs share nodes, so impulses are
// found by projected Gauss-Seidel over the pairs in order: a pair's accumulated normal impulse is never negative, its
// friction impulse at most μ times that (M. Jean, The non-smooth contact dynamics method, 1999, 4).
//
//   first half    pairs that touch on the way from x₀ to x₀ + h v½:   gap(x₀) + h n·Σ w v½ ≥ 0
//   second half   pairs that got an impulse:                                   n·Σ w v  ≥ 0
//
// Normals and weights are evaluated at x₀ and at the step's end respectively. A pair's weights sum to 0, so linear
// momentum is conserved to round-off; so is angular momentum, since the two normal impulses lie on one line. Friction
// impulses do so only at zero gap: friction waits until a pair touches. Contact alone never adds kinetic energy,
// however few the rounds.
#include <heml/tools/contacts.hpp>

namespace heml {

template <class Real>
class SelfContactImpulses {
 public:
  /// Finds the pairs that touch during a step of h (s). before: #V×3, m, at the step's start; after: #V×3, m, at its
  /// end without contact. inverse_mass: #V, 1/kg.
  void find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass, const Real* before,
                  const Real* after);
  /// Keeps the pairs that got an impulse, updates them to positions x, and requires that their gaps do not shrink.
  void begin_second_half(const std::vector<Real>& inverse_mass, const Real* x);

  bool empty() const { return active_.empty(); }
  /// Iterates impulses on v (#V×3, m/s) until the conditions hold or the rounds are used up. May be called again after
  /// other contacts have changed v.
  void solve(const std::vector<Real>& inverse_mass, Real* v);

  /// Calls visit(node) for the nodes of each pair.
  template <class Visit>
  void each_node(const Visit& visit) const {
    for (const ActiveContact& touch : active_)
      for (const int n : touch.point.nodes) visit(n);
  }

  /// Calls visit(point) for each pair.
  template <class Visit>
  void each_contact_point(const Visit& visit) const {
    for (const ActiveContact& touch : active_) visit(touch.point);
  }

  /// Adds the normal impulses (N s) since find_pairs() or begin_second_half(), times weight, to normal_force, and
  /// friction's work to the report.
  void publish(double weight, double& normal_force, ContactReport& report) const;

 private:
  struct ActiveContact {
    ContactPair pair;
    ContactPoint point;
    double min_gap_rate;                   ///< m/s, lower bound of the gap's rate
    double inverse_mass;                   ///< 1/kg, effective inverse mass
    bool has_friction;                     ///< touches, so that friction acts
    double normal = 0;                     ///< N s, accumulated
    Vec3 friction_impulse = Vec3::Zero();  ///< N s, of friction
    double work = 0;                       ///< J, of friction
  };
  double solve_pair(ActiveContact& touch, const std::vector<Real>& inverse_mass, Real* v) const;

  std::vector<ActiveContact> active_;
  double friction_ = 0;
};

}  // namespace heml
