#pragma once
// Shared by laws with a separate volume term: the powers of J in the isochoric invariants Ī1 = J^(−2/3) I1 and
// Ī2 = J^(−4/3) I2, and volume terms.
//
// `continued` replaces the powers and the logarithm below J0 by their second-order Taylor polynomials at J0: C2 and
// finite through J = 0. Without it, J^(−2/3) of an inverted element is (1/J²)^(1/3), undefined at J = 0.
#include <cmath>
#include <heml/materials/law.hpp>
#include <heml/math/elementary.hpp>

namespace heml {

/// J0, below which laws are continued.
template <class Real>
inline constexpr Real continuation_start = Real(0.3);

/// Smallest |J| at which the logarithm and powers of J count as defined. Stiffness has powers down to J⁻⁴ (yeoh), which
/// at moduli of 1e6 Pa overflow a float (3e38) at 1e-8. A smaller J of a float is round-off anyway.
template <class Real>
inline constexpr Real min_volume_ratio = std::numeric_limits<Lane<Real>>::digits == 24 ? Real(1e-7) : Real(1e-12);

/// p = J^(−2/3) and q = J^(−4/3) with two derivatives each.
template <class Real>
struct VolumePowers {
  Real p, p1, p2, q, q1, q2;
};

template <bool continued, class Real>
[[gnu::always_inline]] inline VolumePowers<Real> volume_powers(Real J) {
  const Real magnitude = select(J < 0, -J, J);
  const Real start = continuation_start<Real>, c = continued ? select(J > start, J, start) : J;
  const Real p = natural_exp(Real(-2.0 / 3) * natural_log(continued ? c : magnitude)), q = p * p;
  const Real i = 1 / c;
  // Derivatives at c. d|J|^a/dJ = a |J|^a / J: the sign of J enters through i alone.
  const Real p1 = Real(-2.0 / 3) * p * i, p2 = Real(10.0 / 9) * p * i * i;
  const Real q1 = Real(-4.0 / 3) * q * i, q2 = Real(28.0 / 9) * q * i * i;
  if constexpr (!continued) return {p, p1, p2, q, q1, q2};
  const Real d = J - c;
  return {p + d * (p1 + d / 2 * p2), p1 + d * p2, p2, q + d * (q1 + d / 2 * q2), q1 + d * q2, q2};
}

/// Ī1 and Ī2 for any scalar, jets included: for laws given by their energy alone (autodiff_law.hpp).
template <bool continued, class T>
Invariants<T> isochoric(const Invariants<T>& at) {
  const T start(0.3);
  const T magnitude = select(at.J < T(0), -at.J, at.J);
  const T c = continued ? select(at.J > start, at.J, start) : magnitude;
  const T p = natural_exp(T(-2.0 / 3) * natural_log(c));
  if constexpr (!continued) return {p * at.I1, p * p * at.I2, at.J};
  const T d = (at.J - c) / c;  // above the start, zero with zero derivatives
  return {p * (T(1) - d * T(2.0 / 3) + d * d * T(5.0 / 9)) * at.I1,
          p * p * (T(1) - d * T(4.0 / 3) + d * d * T(14.0 / 9)) * at.I2, at.J};
}

/// Volume terms κ/2 (ln J)² and κ/4 (J² − 1 − 2 ln J) (Simo & Taylor 1982), as a law that is added to the isochoric
/// part of another. The default κ/2 (J−1)² is part of the laws themselves.
template <class Real, bool continued, bool simo_taylor>
struct VolumeLaw {
  Real kappa;

  static constexpr Parameter<VolumeLaw, Real> parameters[] = {
      {&VolumeLaw::kappa, {"kappa", "κ", "Pa", "bulk modulus"}}};
  static constexpr bool has_volume_term = true, uses_I2 = false, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = continued;

  Mask<Real> valid(const Invariants<Real>& at) const { return continued || at.J > min_volume_ratio<Real>; }
  Real energy(const Invariants<Real>& at) const { return value(at.J).w; }
  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const { return {0, 0, value(at.J).w1}; }
  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    return {0, 0, 0, 0, 0, value(at.J).w2};
  }

 private:
  struct Value {
    Real w, w1, w2;
  };
  Value value(Real J) const {
    const Real start = continuation_start<Real>, c = continued ? select(J > start, J, start) : J;
    const Real l = natural_log(c), i = 1 / c, d = J - c;
    const Real w = simo_taylor ? kappa / 4 * (c * c - 1 - 2 * l) : kappa / 2 * l * l;
    const Real w1 = simo_taylor ? kappa / 2 * (c - i) : kappa * l * i;
    const Real w2 = simo_taylor ? kappa / 2 * (1 + i * i) : kappa * (1 - l) * i * i;
    if constexpr (!continued) return {w, w1, w2};
    return {w + d * (w1 + d / 2 * w2), w1 + d * w2, w2};
  }
};

}  // namespace heml
