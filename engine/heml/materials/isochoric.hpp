#pragma once
// Base class of laws W = w(Ī1, Ī2) + κ/2 (J−1)²: applies the chain rule from w's derivatives to I1, I2 and J.
//
// A law derives from IsochoricLaw<itself, Real, continued>, has a member kappa, and implements part(Ī1, Ī2).
#include <heml/materials/volume.hpp>

namespace heml {

/// w(a, b) and its derivatives, Pa.
template <class Real>
struct IsochoricPart {
  Real w, a, b, aa = 0, ab = 0, bb = 0;
};

template <class Self, class Real, bool continued>
struct IsochoricLaw {
  static constexpr bool has_volume_term = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = continued, is_stress_free = true;
  static constexpr SmallStrainModuli sample = {1e3, 5e4};

  Mask<Real> valid(const Invariants<Real>& at) const {
    return continued || at.J > min_volume_ratio<Real> || at.J < -min_volume_ratio<Real>;
  }

  Real energy(const Invariants<Real>& at) const {
    const auto v = volume_powers<continued>(at.J);
    return self().part(v.p * at.I1, v.q * at.I2).w + self().kappa / 2 * (at.J - 1) * (at.J - 1);
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const auto v = volume_powers<continued>(at.J);
    const auto w = self().part(v.p * at.I1, v.q * at.I2);
    Real wJ = w.a * v.p1 * at.I1 + self().kappa * (at.J - 1);
    if constexpr (Self::uses_I2) wJ += w.b * v.q1 * at.I2;
    return {w.a * v.p, w.b * v.q, wJ};
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    const auto v = volume_powers<continued>(at.J);
    const auto w = self().part(v.p * at.I1, v.q * at.I2);
    const Real aJ = v.p1 * at.I1, bJ = v.q1 * at.I2;  // ∂Ī/∂J
    SecondDerivatives<Real> c;
    c.w11 = w.aa * v.p * v.p;
    c.w12 = w.ab * v.p * v.q;
    c.w22 = w.bb * v.q * v.q;
    c.w1J = w.a * v.p1 + v.p * (w.aa * aJ + w.ab * bJ);
    c.w2J = w.b * v.q1 + v.q * (w.ab * aJ + w.bb * bJ);
    c.wJJ =
        w.a * v.p2 * at.I1 + w.b * v.q2 * at.I2 + w.aa * aJ * aJ + 2 * w.ab * aJ * bJ + w.bb * bJ * bJ + self().kappa;
    return c;
  }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

}  // namespace heml
