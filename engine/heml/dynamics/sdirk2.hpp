#pragma once
// SDIRK2 (Alexander 1977): two stages of equal length γh, γ = 1 − 1/√2. Second order, L-stable, stiffly accurate. Both
// stages share one factorisation, and neither needs the forces at the start of the step, so that a start far from
// equilibrium is damped from the first stage on.
#include <cmath>
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/dynamics/integrator.hpp>

namespace heml {

struct Sdirk2 {
  static constexpr IntegratorInfo info{
      Integrator::sdirk2, "sdirk2", "SDIRK2", "SD", IntegratorKind::implicit_steps, 2, 2};
  static bool step(ImplicitStep& s) {
    static const double gamma = 1 - std::sqrt(0.5);
    const double d = gamma * s.h, rest = s.h - d;
    if (!s.solve({d, *s.x_start, *s.v_start}, d)) return false;
    const Vector acceleration = (s.v - *s.v_start) / d;
    return s.solve({d, *s.x_start + rest * s.v, *s.v_start + rest * acceleration}, s.h);
  }
};

}  // namespace heml
