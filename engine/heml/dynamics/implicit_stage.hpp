#pragma once
// Stages of implicit methods, and the interface by which a method makes a step of stages. A stage determines x and v
// such that
//     x = x̄ + d v,   v = v̄ + d (M⁻¹ f(x) − α v),
// f with gravity, α mass damping, so it makes Φ = a/2 ‖x − y‖²_M + U(x) stationary with
//     a = (1 + αd)/d²,   y = x̄ + d v̄/(1 + αd),   and then v = (x − x̄)/d.
#include <heml/dynamics/objective.hpp>

namespace heml {

struct Stage {
  double d;             ///< s
  Vector x_bar, v_bar;  ///< 3 #V; m, m/s

  double a(double damping) const { return (1 + damping * d) / (d * d); }
  Vector y(double damping) const { return x_bar + d / (1 + damping * d) * v_bar; }
  Vector velocity(const Vector& x) const { return (x - x_bar) / d; }
};

/// One step of an implicit method. A method is a type with `static bool step(ImplicitStep&)` that solves its stages in
/// order and returns whether all of them converged; the last stage ends the step.
class ImplicitStep {
 public:
  virtual ~ImplicitStep() = default;
  /// Solves a stage that ends h_end seconds after the start of the step. Writes x and v; returns false where it does
  /// not converge.
  virtual bool solve(const Stage& stage, double h_end) = 0;
  /// Acceleration at the start of the step from all forces, damping included, 3 #V, m/s².
  virtual Vector acceleration() const = 0;

  double h = 0;                                         ///< s
  Vector x, v;                                          ///< 3 #V, m, m/s: result of the last stage, at first the start
  const Vector *x_start = nullptr, *v_start = nullptr;  ///< state at the start of the step
  const Vector *x_before = nullptr, *v_before = nullptr;  ///< state one step earlier
  double h_before = 0;                                    ///< s, length of that step; 0: there was none
};

}  // namespace heml
