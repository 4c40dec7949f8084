#pragma once
// Tissue against tissue in explicit steps: what tables do to a node in closed form (contact_impulses.hpp), pairs that
// share nodes find together, by Gauss and Seidel's rounds over them in order; what a pair has got in all is never
// negative, and friction at most μ times it (M. Jean, The non-smooth contact dynamics method, 1999, 4).
//
//   first half    of pairs that meet on the way from x₀ to x₀ + h v½:   gap(x₀) + h n·Σ w v½ ≥ 0
//   second half   of those that were pushed:                                     n·Σ w v  ≥ 0
//
// Directions and weights are those where the velocities count from, and a pair's weights have no sum: momentum is kept
// to round-off, and of moment, which two impulses on one line have none of. So friction waits until tissue has met. A
// state without the impulses would be one with more kinetic energy: contact alone never adds any, however few the
// rounds.
#include <heml/tools/contacts.hpp>

namespace heml {

template <class Real>
class SelfContactImpulses {
 public:
  /// Which pairs meet: before: positions at the step's start, after: those at its end if nothing stops them, 3 #V. h:
  /// s.
  void meet(SelfContact& contact, double h, const std::vector<Real>& inverse_mass, const Real* before,
            const Real* after);
  /// The pairs that were pushed, as they lie now, are to come no nearer.
  void stop(const std::vector<Real>& inverse_mass, const Real* x);

  bool empty() const { return active_.empty(); }
  /// Changes velocities, 3 #V, until all is as it is to be. It may be done again when others have changed them.
  void push(const std::vector<Real>& inverse_mass, Real* v);

  /// Calls visit(node) for the nodes of pairs.
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

  /// Adds what was done since meet() or stop(), with a weight, to the deeds of a tick; of its forces, N s.
  void publish(double weight, double& normal_force, ContactReport& report) const;

 private:
  struct ActiveContact {
    ContactPair pair;
    ContactPoint point;
    double least;               ///< m/s, that the gap is to grow by
    double light;               ///< 1/kg, of the pair's motion
    bool rubs;                  ///< has met
    double normal = 0;          ///< N s, so far
    Vec3 along = Vec3::Zero();  ///< N s, friction's
    double work = 0;            ///< J, friction's
  };
  double push(ActiveContact& touch, const std::vector<Real>& inverse_mass, Real* v) const;

  std::vector<ActiveContact> active_;
  double friction_ = 0;
};

}  // namespace heml
