#pragma once
// What an implicit or static solve makes stationary: a function Φ of all positions (3 numbers a node), seen through its
// residual −∇Φ, its stiffness ∂²Φ/∂x², and, where the forces have one, its value. Solvers know nothing else of a body,
// so tests solve small functions of their own. All in double, whatever a body computes in.
#include <Eigen/Core>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/solver_options.hpp>
#include <optional>

namespace heml {

class BsrMatrix;

using Vector = Eigen::VectorXd;  ///< 3 #V: node after node

class Objective {
 public:
  virtual ~Objective() = default;
  /// r = −∇Φ at x, N; 0 at nodes that are not free. Returns whether Φ is defined there.
  virtual bool residual(const Vector& x, Vector& r) = 0;
  /// Φ at x, J; differences alone matter. None where the forces have no potential.
  virtual std::optional<double> value(const Vector& x) = 0;
  /// Up to what difference values are round-off, J.
  virtual double value_round_off() const = 0;
  /// Whether a residual is no more than the round-off of forces.
  virtual bool is_at_round_off(const Vector&) const { return false; }
  /// Whether a step from one x to another is long and turns elements inside out: shorter ones are tried first.
  virtual bool inverts_elements(const Vector&, const Vector&) const { return false; }
  /// Finds K = −∂r/∂x at x, or its projection, which the calls below are about until the next one.
  virtual void linearise(const Vector& x, Projection projection = Projection::none) = 0;
  /// out = K dx; 0 at nodes that are not free. dx may move those.
  virtual void product(const Vector& dx, Vector& out) = 0;
  /// Whether K is: it is where the forces have a potential.
  virtual bool is_symmetric() const { return true; }
  /// Adds the blocks of K between free nodes, its symmetric part, or an approximation of it.
  virtual void add_stiffness(BlockMatrix& matrix) = 0;
  /// Adds K between free nodes to rows in float, where it is symmetric and they can hold it. Returns whether.
  virtual bool add_stiffness_single_precision(BsrMatrix&) { return false; }
};

}  // namespace heml
