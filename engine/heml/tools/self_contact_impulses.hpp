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

  bool empty() const { return rows_.empty(); }
  /// Applies the impulses of the last step's same half to v (#V×3, m/s), unless they would add energy. At most once,
  /// before solve().
  void warm_start(Real* v);
  /// Iterates impulses on v (#V×3, m/s) until the conditions hold or the rounds are used up: at most 60, or 4 where all
  /// pairs are of earlier steps. May be called again after other contacts have changed v.
  void solve(Real* v);
  /// Updates the memory after the first half, which ended at x (#V×3, m); call it before begin_second_half().
  /// known: as in find_pairs().
  void remember_first_half(const Real* x, std::vector<RememberedPair>& known) const;
  void remember_second_half(std::vector<RememberedPair>& known) const;

  int rounds() const { return rounds_; }         ///< since find_pairs()
  double residual() const { return residual_; }  ///< change of an impulse in the last round, of the largest impulse

  /// Nodes of the pairs that find_pairs() found, each once.
  const std::vector<int>& nodes() const { return nodes_; }
  bool has_node(int n) const { return static_cast<std::size_t>(n) < local_.size() && local_[index(n)] >= 0; }

  /// Calls visit(point) for each pair.
  template <class Visit>
  void each_contact_point(const Visit& visit) const {
    for (const Touch& touch : touches_) visit(touch.point);
  }

  /// Adds the normal impulses (N s) since find_pairs() or begin_second_half(), times weight, to normal_force, and
  /// friction's work to the report.
  void publish(double weight, double& normal_force, ContactReport& report) const;

 private:
  using Vec4 = Eigen::Vector4d;  ///< x, y, z, 0: two registers of any processor, and no remainder
  /// What a pair is, and what it carries over.
  struct Touch {
    ContactPair pair;
    ContactPoint point;
    std::ptrdiff_t known;  ///< place among the pairs of earlier steps; −1: new
    bool starts_warm;      ///< got an impulse in the last step
    std::array<RememberedPair::Impulse, 2> last;
  };
  /// What the rounds read and write: small, so that all pairs stay in the first-level cache.
  struct Row {
    Vec4 normal, drift;                ///< drift: m/s, velocity along the surface that friction adds to that of sliding
    Vec4 friction_impulse;             ///< N s
    std::array<int, 4> nodes;          ///< indices into velocities_
    std::array<double, 4> weights;
    std::array<double, 4> mobility;    ///< 1/kg, velocities of the nodes for an impulse of 1 N s
    double min_gap_rate;               ///< m/s, lower bound of the gap's rate
    double inverse_mass, mass;         ///< 1/kg and kg, effective
    double normal_impulse = 0;         ///< N s, accumulated
    double work = 0;                   ///< J, of friction
    bool has_friction;                 ///< touches, so that friction acts
    bool is_known;
  };
  static std::size_t index(int n) { return static_cast<std::size_t>(n); }
  Row row_of(const ContactPoint& point, double effective_inverse_mass, const std::vector<Real>& inverse_mass);
  Vec4 velocity_of(const Row& row) const;
  void add_impulse(const Row& row, const Vec4& impulse);
  double solve_pair(Row& row);
  void load(const Real* v);
  void store(Real* v) const;

  std::vector<Touch> touches_;
  std::vector<Row> rows_;         ///< of each touch
  std::vector<int> nodes_;        ///< of all rows
  std::vector<int> local_;        ///< of each node of the body, its index in nodes_; −1: in no pair
  std::vector<Vec4> velocities_;  ///< m/s, of nodes_ while the rounds run
  double friction_ = 0;
  std::size_t half_ = 0;  ///< 0: the first
  bool is_warm_ = true;   ///< the impulses of the last step were a good start
  int rounds_ = 0;
  double residual_ = 0;
};

}  // namespace heml
