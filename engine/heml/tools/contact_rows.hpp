#pragma once
// Impulses at contact points that share nodes, by projected Gauss-Seidel over the points in order: a point's
// accumulated normal impulse is never negative, its friction impulse at most μ times that (M. Jean, The non-smooth
// contact dynamics method, 1999, 4). A visit may take back what an earlier one gave too much, so that a body at rest
// gets none but the impulses that hold it; pushes that only add would shake it in every step.
//
// Rounds start with the impulses of the last step, unless those would add energy. So a body at rest needs few rounds
// in a step: what they leave over is smaller in the next. Visits alone never add kinetic energy, however few.
#include <heml/tools/contact_memory.hpp>

namespace heml {

/// When the rounds end.
struct RoundLimit {
  int rounds;
  double tolerance;  ///< of the largest impulse: smaller changes end them
};

template <class Real>
class ContactRows {
 public:
  using Vec4 = Eigen::Vector4d;  ///< x, y, z, 0: two registers of any processor, and no remainder
  /// What the rounds read and write of a point: small, so that all stay in the first-level cache.
  struct Row {
    Vec4 normal;
    Vec4 drift;                      ///< m/s, velocity along the surface that friction adds to that of sliding
    Vec4 friction_impulse;           ///< N s, accumulated; before start(): of the last step
    std::array<int, 4> nodes;        ///< indices into velocities_
    std::array<double, 4> weights;
    std::array<double, 4> mobility;  ///< 1/kg, velocities of the nodes for an impulse of 1 N s
    double min_gap_rate;             ///< m/s, lower bound of the point's velocity along the normal
    double inverse_mass, mass;       ///< 1/kg and kg, effective
    double normal_impulse;           ///< N s, as friction_impulse
    double work;                     ///< J, of friction
    double friction;                 ///< Coulomb's coefficient; 0: none, as where the point does not touch yet
    bool is_known;                   ///< of an earlier step
  };

  /// Removes all rows; bodies have node_count nodes from now on.
  void clear(std::size_t node_count);
  /// Adds a point without impulse and drift. effective_inverse_mass: 1/kg, of the point, above 0. The reference holds
  /// until the next call.
  Row& add(const ContactPoint& point, double effective_inverse_mass, const std::vector<Real>& inverse_mass);
  /// Replaces row i by one without impulse.
  Row& replace(std::size_t i, const ContactPoint& point, double effective_inverse_mass,
               const std::vector<Real>& inverse_mass);
  /// Keeps the first `count` rows.
  void shrink_to(std::size_t count) { rows_.resize(count); }
  std::vector<Row>& rows() { return rows_; }
  const std::vector<Row>& rows() const { return rows_; }

  /// Applies the impulses that rows have to v (#V×3, m/s) or, where they would add energy, sets them to 0. At most once
  /// before solve().
  void start(Real* v);
  /// Iterates impulses on v until the conditions hold or the rounds are used up: `warm` where all points with an
  /// impulse are of earlier steps and these started, else `cold`. May be called again after others have changed v.
  void solve(const RoundLimit& warm, const RoundLimit& cold, Real* v);
  /// Replaces row i by one with its impulses along another normal, in v too.
  void turn(std::size_t i, const ContactPoint& point, double effective_inverse_mass,
            const std::vector<Real>& inverse_mass, Real* v);

  int rounds() const { return rounds_; }         ///< since clear()
  double residual() const { return residual_; }  ///< change of an impulse in the last round, of the largest impulse

  /// Nodes of all rows since clear(), each once.
  const std::vector<int>& nodes() const { return nodes_; }
  bool has_node(int n) const { return index(n) < local_.size() && local_[index(n)] >= 0; }

 private:
  static std::size_t index(int n) { return static_cast<std::size_t>(n); }
  Row row_of(const ContactPoint& point, double effective_inverse_mass, const std::vector<Real>& inverse_mass);
  Vec4 velocity_of(const Row& row) const;
  void add_impulse(const Row& row, const Vec4& impulse);
  double visit(Row& row);
  void apply(const Row& row, double sign, Real* v) const;
  void load(const Real* v);
  void store(Real* v) const;

  std::vector<Row> rows_;
  std::vector<int> nodes_;
  std::vector<int> local_;        ///< of each node of the body, its index in nodes_; −1: in no row
  std::vector<Vec4> velocities_;  ///< m/s, of nodes_ while the rounds run
  bool is_warm_ = true;           ///< the impulses of the last step were a good start
  int rounds_ = 0;
  double residual_ = 0;
};

inline Eigen::Vector4d padded(const Vec3& x) { return {x[0], x[1], x[2], 0}; }

/// Gives a row the impulse of an earlier step to start with.
template <class Row>
void start_with(const ContactImpulse& impulse, Row& row) {
  row.normal_impulse = impulse.normal;
  row.friction_impulse = padded(impulse.friction);
}

template <class Row>
ContactImpulse impulse_of(const Row& row) {
  return {row.normal_impulse, row.friction_impulse.template head<3>()};
}

}  // namespace heml
