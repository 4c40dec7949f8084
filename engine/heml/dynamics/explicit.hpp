#pragma once
// The two explicit methods, each split at the evaluation of the forces. A step is first_half_step, motion of the
// constrained nodes, forces at the new positions, second_half_step. α: mass damping, 1/s. Coordinates with inverse mass
// 0 (constrained nodes, nodes without elements) are not accelerated. Arrays are per coordinate (3 #V), so that loops
// vectorise. Output arrays may be the input arrays; separate ones allow a step to be rejected.
#include <cmath>
#include <cstddef>

namespace heml {

/// Input and output arrays of first_half_step.
template <class Real>
struct FirstHalfStep {
  const Real *inverse_mass, *f, *x, *v;  ///< 1/kg, N, m, m/s
  Real *x_after, *v_after;
};

/// The paper's "semi-implicit first-order Euler": v = (v + h M⁻¹ f(x)) / (1 + αh); x += h v. Damping is implicit, so
/// that the stability limit stays h < 2/ω_max.
template <class Real>
struct SymplecticEuler {
  /// Divisor of the velocities in the first half step.
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

/// Velocity Verlet with damping, second order: v½ = (v + ½h a)/(1+½αh); x += h v½; v = (1−½αh) v½ + ½h a(x).
template <class Real>
struct Verlet {
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
