#pragma once
// Backward Euler: first order, L-stable, damps all motion that the step does not resolve.
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/dynamics/integrator.hpp>

namespace heml {

inline Stage backward_euler_stage(const Vector& x, const Vector& v, double h) { return {h, x, v}; }

struct BackwardEuler {
  static constexpr IntegratorInfo info{
      Integrator::backward_euler, "backward_euler", "Backward Euler", "BE", IntegratorKind::implicit_steps, 1, 1};
  static bool step(ImplicitStep& s) { return s.solve(backward_euler_stage(s.x, s.v, s.h), s.h); }
};

}  // namespace heml
