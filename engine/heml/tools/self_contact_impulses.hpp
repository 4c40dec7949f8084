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
// however few the rounds. Rounds start with the impulses of the last step, unless those would add energy. So a body at
// rest needs few rounds in a step: what they leave over is smaller in the next. Friction draws sticking pairs back to
// their anchors (contact_memory.hpp).
#include <heml/tools/contact_memory.hpp>
#include <heml/tools/contacts.hpp>

namespace heml {

template <class Real>
class SelfContactImpulses {
 public:
  /// Finds the pairs that touch during a step of h (s). before: #V×3, m, at the step's start; after: #V×3, m, at its
  /// end without contact. inverse_mass: #V, 1/kg. known: pairs of earlier steps, ascending.
  void find_pairs(SelfContact& contact, double h, const std::vector<Real>& inverse_mass, const Real* before,
                  const Real* after, const std::vector<RememberedPair>& known = {});
  /// Keeps the pairs that got an impulse, updates them to positions x, and requires that their gaps do not shrink.
  void begin_second_half(const std::vector<Real>& inverse_mass, const Real* x);

  bool empty() const { return active_.empty(); }
  /// Applies the impulses of the last step's same half to v (#V×3, m/s), unless they would add energy. At most once,
  /// before solve().
  void warm_start(Real* v);
  /// Iterates impulses on v (#V×3, m/s) until the conditions hold or the rounds are used up: at most 60, or 4 where all
  /// pairs are of earlier steps. May be called again after other contacts have changed v.
  void solve(Real* v);
  /// Updates the memory after the first half, which ended at x (#V×3, m); call it before begin_second_half().
  void remember_first_half(const Real* x, std::vector<RememberedPair>& known) const;
  void remember_second_half(std::vector<RememberedPair>& known) const;

  int rounds() const { return rounds_; }         ///< since find_pairs()
  double residual() const { return residual_; }  ///< change of an impulse in the last round, of the largest impulse

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
    RememberedPair memory;  ///< of earlier steps, where is_known
    bool is_known;
    ContactPoint point;
    double min_gap_rate;                   ///< m/s, lower bound of the gap's rate
    double inverse_mass;                   ///< 1/kg, effective inverse mass
    std::array<double, 4> mobility;        ///< 1/kg, velocities of the nodes for an impulse of 1 N s
    bool has_friction;                     ///< touches, so that friction acts
    Vec3 drift;                            ///< m/s, velocity along the surface that friction adds to that of sliding
    double normal = 0;                     ///< N s, accumulated
    Vec3 friction_impulse = Vec3::Zero();  ///< N s, of friction
    double work = 0;                       ///< J, of friction
  };
  double solve_pair(ActiveContact& touch, Real* v) const;

  std::vector<ActiveContact> active_;
  double friction_ = 0;
  std::size_t half_ = 0;  ///< 0: the first
  bool is_warm_ = true;   ///< the impulses of the last step were a good start
  int rounds_ = 0;
  double residual_ = 0;
};

}  // namespace heml
