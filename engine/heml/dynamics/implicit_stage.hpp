#pragma once
// Stages of implicit methods. A stage determines x and v such that
//     x = x̄ + d v,   v = v̄ + d (M⁻¹ f(x) − α v),
// f with gravity, α mass damping; so x makes Φ = a/2 ‖x − y‖²_M + U(x) stationary with
//     a = (1 + αd)/d²,   y = x̄ + d v̄/(1 + αd),   and then v = (x − x̄)/d.
#include <cmath>
#include <heml/dynamics/objective.hpp>

namespace heml {

struct Stage {
  double d;             ///< s
  Vector x_bar, v_bar;  ///< 3 #V; m, m/s

  double a(double damping) const { return (1 + damping * d) / (d * d); }
  Vector y(double damping) const { return x_bar + d / (1 + damping * d) * v_bar; }
  Vector velocity(const Vector& x) const { return (x - x_bar) / d; }
};

inline Stage backward_euler_stage(const Vector& x, const Vector& v, double h) { return {h, x, v}; }

/// BDF2 with variable coefficients, second order for steps of any lengths (fixed coefficients lose the order).
/// x_before, v_before: state before the last step, which had length h_before.
inline Stage bdf2_stage(const Vector& x, const Vector& v, const Vector& x_before, const Vector& v_before, double h,
                        double h_before) {
  const double ratio = h / h_before, of_now = (1 + ratio) * (1 + ratio) / (1 + 2 * ratio),
               of_before = ratio * ratio / (1 + 2 * ratio);
  return {h * (1 + ratio) / (1 + 2 * ratio), of_now * x - of_before * x_before, of_now * v - of_before * v_before};
}

/// TR-BDF2 (Bank et al. 1985; Hosea & Shampine 1996): the trapezoidal rule to t + γh, then BDF2 to t + h. With γ = 2 −
/// √2 both stages have the same d and share one factorisation.
namespace tr_bdf2 {

inline const double gamma = 2 - std::sqrt(2.0);

/// acceleration: m/s² at x, v, with gravity and damping.
inline Stage first_stage(const Vector& x, const Vector& v, const Vector& acceleration, double h) {
  const double d = gamma * h / 2;
  return {d, x + d * v, v + d * acceleration};
}

inline Stage second_stage(const Vector& x, const Vector& v, const Vector& x_gamma, const Vector& v_gamma, double h) {
  const double w = 1 / (gamma * (2 - gamma)), w2 = (1 - gamma) * (1 - gamma) * w;
  return {gamma * h / 2, w * x_gamma - w2 * x, w * v_gamma - w2 * v};
}

}  // namespace tr_bdf2
}  // namespace heml
