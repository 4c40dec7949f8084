#pragma once
// The function Φ of all positions that an implicit or static solve makes stationary: its residual −∇Φ, its stiffness
// ∂²Φ/∂x² and, if the forces have a potential, its value. Solvers know no more of a body, so tests can solve small
// functions. All in double, whatever precision a body uses.
#include <Eigen/Core>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/solver_options.hpp>
#include <optional>

namespace heml {

class BsrMatrix;

/// A part sign g gᵀ of a stiffness, between few nodes.
struct RankOneTerm {
  int count;                 ///< of nodes
  std::array<int, 4> nodes;  ///< all different
  std::array<Vec3, 4> g;     ///< √(N/m)
  double sign = 1;           ///< or −1; preconditioners leave those out
};

using Vector = Eigen::VectorXd;  ///< 3 #V: node after node

/// The mass (kg) of a node that is free in one direction at least. masses: 3 #V, kg, 0 where not free.
inline double mass_of_node(const Vector& masses, int node) { return masses.segment<3>(3 * node).maxCoeff(); }

class Objective {
 public:
  virtual ~Objective() = default;
  /// r = −∇Φ at x, N; 0 at nodes that are not free. Returns whether Φ is defined there.
  virtual bool residual(const Vector& x, Vector& r) = 0;
  /// Φ at x, J, up to a constant. None if the forces have no potential.
  virtual std::optional<double> value(const Vector& x) = 0;
  /// Differences of values up to this are round-off, J.
  virtual double value_round_off() const = 0;
  /// Whether a residual is within the round-off of forces.
  virtual bool is_at_round_off(const Vector&) const { return false; }
  /// Where values are round-off: evaluates the same function more precisely from now on. Returns false if it cannot, or
  /// already does.
  virtual bool refine_precision() { return false; }
  /// Whether a step between two x is long and inverts elements; shorter ones are then tried first.
  virtual bool inverts_elements(const Vector&, const Vector&) const { return false; }
  /// Evaluates K = −∂r/∂x at x, or its projection, for the calls below until the next linearise().
  virtual void linearise(const Vector& x, Projection projection = Projection::none) = 0;
  /// Since linearise(), this part of the step that K suggests was taken.
  virtual void step_taken(double) {}
  /// out = K dx, N; 0 at nodes that are not free, where dx may be nonzero.
  virtual void product(const Vector& dx, Vector& out) = 0;
  /// Whether K is symmetric, as it is if the forces have a potential.
  virtual bool is_symmetric() const { return true; }
  /// Adds the blocks of K between free nodes that the matrix has a place for; the symmetric part or an approximation
  /// will do.
  virtual void add_stiffness(BlockMatrix& matrix) = 0;
  /// Adds the pairs of nodes that K couples and that share no element; any order, some perhaps more than once.
  virtual void add_coupled_pairs(std::vector<std::array<int, 2>>&) const {}
  /// Makes a matrix in float K between free nodes, without its rank-one terms. Returns false if K is not symmetric
  /// or does not fit the sparsity pattern.
  virtual bool assemble_single_precision(BsrMatrix&) { return false; }
  /// The parts of K that couple few nodes each and are no elements'.
  virtual void add_rank_one_terms(std::vector<RankOneTerm>&) const {}
};

}  // namespace heml
