#pragma once
// Self-contact in explicit steps. Unlike a node on a table (contact_impulses.hpp), pairs share nodes, so impulses are
// found in rounds (contact_rows.hpp).
//
//   first half    pairs that touch on the way from x₀ to x₀ + h v½:   gap(x₀) + h n·Σ w v½ ≥ 0
//   second half   pairs that got an impulse:                                   n·Σ w v  ≥ 0
//
// Normals and weights are evaluated at x₀ and at the step's end respectively. A pair's weights sum to 0, so linear
// momentum is conserved to round-off; so is angular momentum, since the two normal impulses lie on one line. Friction
// impulses do so only at zero gap: friction waits until a pair touches. Friction draws sticking pairs back to their
// anchors (contact_memory.hpp).
#include <heml/tools/contact_memory.hpp>
#include <heml/tools/contact_rows.hpp>
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

  bool empty() const { return touches_.empty(); }
  /// Applies the impulses of the last step's same half to v (#V×3, m/s), unless they would add energy. At most once,
  /// before solve().
  void warm_start(Real* v) { rows_.start(v); }
  /// Iterates impulses on v (#V×3, m/s) until the conditions hold or the rounds are used up: at most 60, or 4 where all
  /// pairs are of earlier steps. May be called again after other contacts have changed v.
  void solve(Real* v);
  /// Updates the memory after the first half, which ended at x (#V×3, m); call it before begin_second_half().
  /// known: as in find_pairs().
  void remember_first_half(const Real* x, std::vector<RememberedPair>& known) const;
  void remember_second_half(std::vector<RememberedPair>& known) const;

  int rounds() const { return rows_.rounds(); }         ///< since find_pairs()
  double residual() const { return rows_.residual(); }  ///< change of an impulse in the last round, of the largest

  /// Nodes of the pairs that find_pairs() found, each once.
  const std::vector<int>& nodes() const { return rows_.nodes(); }
  bool has_node(int n) const { return rows_.has_node(n); }

  /// Calls visit(point) for each pair.
  template <class Visit>
  void each_contact_point(const Visit& visit) const {
    for (const Touch& touch : touches_) visit(touch.point);
  }

  /// Adds the normal impulses (N s) since find_pairs() or begin_second_half(), times weight, to normal_force, and
  /// friction's work to the report.
  void publish(double weight, double& normal_force, ContactReport& report) const;

 private:
  /// What a pair is, and what it carries over.
  struct Touch {
    ContactPair pair;
    ContactPoint point;
    std::ptrdiff_t known;  ///< place among the pairs of earlier steps; −1: new
    std::array<ContactImpulse, 2> last;  ///< of the last step's halves
  };

  ContactRows<Real> rows_;  ///< of each touch
  std::vector<Touch> touches_;
  std::vector<ContactPair> held_;  ///< that got an impulse in the last step
  double friction_ = 0;
};

}  // namespace heml
