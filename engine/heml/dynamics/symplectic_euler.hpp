#pragma once
// Symplectic Euler, the method of the paper.
#include <heml/dynamics/explicit_step.hpp>
#include <heml/dynamics/integrator.hpp>

namespace heml {

/// The paper's "semi-implicit first-order Euler": v = (v + h M⁻¹ f(x)) / (1 + αh); x += h v. Damping is
/// implicit, so that the stability limit stays h < 2/ω_max.
template <class Real>
struct SymplecticEuler {
  static constexpr IntegratorInfo info{
      Integrator::symplectic_euler, "symplectic_euler", "Symplectic Euler", "SE", IntegratorKind::explicit_steps, 1, 1};
  /// The divisor of velocities in the first half step.
  static double damping_divisor(double h, double damping) { return 1 + damping * h; }
  static void first_half_step(Real h, Real damping, const FirstHalfStep<Real>& at, std::size_t begin, std::size_t end) {
    const auto [inverse_mass, f, x, v, x_after, v_after] = at;
    const Real shrink = 1 / (1 + damping * h);
    for (std::size_t i = begin; i < end; ++i) {
      const Real faster = (v[i] + h * inverse_mass[i] * f[i]) * shrink;
      v_after[i] = faster;
      x_after[i] = x[i] + h * faster;
    }
  }
  static void second_half_step(Real, Real, const Real*, const Real*, Real*, std::size_t, std::size_t) {}
};

}  // namespace heml
