#pragma once
// Velocity Verlet.
#include <heml/dynamics/explicit_step.hpp>
#include <heml/dynamics/integrator.hpp>

namespace heml {

/// Velocity Verlet with damping, second order: v½ = (v + ½h a)/(1+½αh); x += h v½; v = (1−½αh) v½ + ½h a(x).
template <class Real>
struct Verlet {
  static constexpr IntegratorInfo info{
      Integrator::verlet, "verlet", "Verlet", "V", IntegratorKind::explicit_steps, 2, 1};
  static double damping_divisor(double h, double damping) { return 1 + damping * h / 2; }
  static void first_half_step(Real h, Real damping, const FirstHalfStep<Real>& at, std::size_t begin, std::size_t end) {
    const auto [inverse_mass, f, x, v, x_after, v_after] = at;
    const Real shrink = 1 / (1 + damping * h / 2);
    for (std::size_t i = begin; i < end; ++i) {
      const Real faster = (v[i] + h / 2 * inverse_mass[i] * f[i]) * shrink;
      v_after[i] = faster;
      x_after[i] = x[i] + h * faster;
    }
  }
  static void second_half_step(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* v,
                               std::size_t begin, std::size_t end) {
    const Real shrink = 1 - damping * h / 2;
    for (std::size_t i = begin; i < end; ++i) {
      const Real keep = inverse_mass[i] > 0 ? shrink : Real(1);  // constrained nodes keep their prescribed velocity
      v[i] = keep * v[i] + h / 2 * inverse_mass[i] * f[i];
    }
  }
};

}  // namespace heml
