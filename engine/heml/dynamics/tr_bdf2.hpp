#pragma once
// TR-BDF2: second order, L-stable.
#include <cmath>
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/dynamics/integrator.hpp>

namespace heml {

/// TR-BDF2 (Bank et al. 1985; Hosea & Shampine 1996): the trapezoidal rule to t + γh, then BDF2 to t + h; with
/// γ = 2 − √2 both stages have the same d and share one factorisation.
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

struct TrBdf2 {
  static constexpr IntegratorInfo info{
      Integrator::tr_bdf2, "tr_bdf2", "TR-BDF2", "TR", IntegratorKind::implicit_steps, 2, 2};
  static bool step(ImplicitStep& s) {
    return s.solve(tr_bdf2::first_stage(s.x, s.v, s.acceleration(), s.h), tr_bdf2::gamma * s.h) &&
           s.solve(tr_bdf2::second_stage(*s.x_start, *s.v_start, s.x, s.v, s.h), s.h);
  }
};

}  // namespace heml
