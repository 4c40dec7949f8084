#pragma once
// The two explicit methods, each as what it does before and after the forces are taken at the new positions. A step of
// either is first_half, held nodes moved, forces, second_half. α: mass damping, 1/s. Nodes with inverse mass 0 (held,
// or of no element) are not accelerated.
#include <cmath>
#include <cstddef>

namespace heml {

/// The paper's "semi-implicit first-order Euler": v = (v + h M⁻¹ f(x)) / (1 + αh); x += h v. Damping is taken
/// implicitly, so that the limit stays h < 2/ω_max.
template <class Real>
struct SymplecticEuler {
  static void first_half(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* x, Real* v,
                         std::size_t begin, std::size_t end) {
    const Real shrink = 1 / (1 + damping * h);
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t i = 3 * n; i < 3 * n + 3; ++i) {
        v[i] = (v[i] + h * inverse_mass[n] * f[i]) * shrink;
        x[i] += h * v[i];
      }
  }
  static void second_half(Real, Real, const Real*, const Real*, Real*, std::size_t, std::size_t) {}
};

/// Velocity Verlet with damping, second order: v½ = (v + ½h a)/(1+½αh); x += h v½; v = (1−½αh) v½ + ½h a(x).
template <class Real>
struct Verlet {
  static void first_half(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* x, Real* v,
                         std::size_t begin, std::size_t end) {
    const Real shrink = 1 / (1 + damping * h / 2);
    for (std::size_t n = begin; n < end; ++n)
      for (std::size_t i = 3 * n; i < 3 * n + 3; ++i) {
        v[i] = (v[i] + h / 2 * inverse_mass[n] * f[i]) * shrink;
        x[i] += h * v[i];
      }
  }
  static void second_half(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* v, std::size_t begin,
                          std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Real keep =
          inverse_mass[n] > 0 ? 1 - damping * h / 2 : Real(1);  // held nodes keep the velocity they were given
      for (std::size_t i = 3 * n; i < 3 * n + 3; ++i) v[i] = keep * v[i] + h / 2 * inverse_mass[n] * f[i];
    }
  }
};

}  // namespace heml
