#pragma once
// BDF2 with variable steps: second order, one stage, needs the step before. The first step is TR-BDF2's.
#include <heml/dynamics/tr_bdf2.hpp>

namespace heml {

/// BDF2 with variable coefficients, second order for steps of any lengths (fixed coefficients lose the order).
/// x_before, v_before: state before the last step, which had length h_before.
inline Stage bdf2_stage(const Vector& x, const Vector& v, const Vector& x_before, const Vector& v_before, double h,
                        double h_before) {
  const double ratio = h / h_before, of_now = (1 + ratio) * (1 + ratio) / (1 + 2 * ratio),
               of_before = ratio * ratio / (1 + 2 * ratio);
  return {h * (1 + ratio) / (1 + 2 * ratio), of_now * x - of_before * x_before, of_now * v - of_before * v_before};
}

struct Bdf2 {
  static constexpr IntegratorInfo info{Integrator::bdf2, "bdf2", "BDF2", "B2", IntegratorKind::implicit_steps, 2, 1};
  static bool step(ImplicitStep& s) {
    if (!(s.h_before > 0)) return TrBdf2::step(s);
    return s.solve(bdf2_stage(s.x, s.v, *s.x_before, *s.v_before, s.h, s.h_before), s.h);
  }
};

}  // namespace heml
