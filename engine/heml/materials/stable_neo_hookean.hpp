#pragma once
// Stable Neo-Hookean (Smith, De Goes & Kim 2018, Eq. 14, with the constants of its section 3.4 so that λ and μ are
// those of linear elasticity): W = 2μ/3 (I1−3 − ln((I1+1)/4)) + (λ/2 + 5μ/12)(J−1)² − μ (J−1), J signed; 0 at rest.
//
// Defined at every state, with finite stiffness, and without a stable collapsed or inverted state: inverted elements
// are restored, and the logarithm removes the stiffness that I1 alone would give a body shrunk to a point. So it needs
// no continuation, and it is the surrogate of bodies outside the range of their own law (world/recovery_surrogate.hpp).
#include <heml/materials/law.hpp>
#include <heml/math/elementary.hpp>

namespace heml {

template <class Real, bool>
struct StableNeoHookean {
  Real lambda, mu;

  static constexpr std::string_view name = "stable_neo_hookean";
  static constexpr std::string_view title = "Stable Neo-Hookean";
  static constexpr std::string_view formula = "2μ/3 (I1−3 − ln((I1+1)/4)) + (λ/2 + 5μ/12)(J−1)² − μ (J−1)";
  static constexpr std::string_view source = "Smith, De Goes & Kim 2018, Eq. 14";
  static constexpr Parameter<StableNeoHookean, Real> parameters[] = {
      {&StableNeoHookean::lambda, {"lambda", "λ", "Pa", "first Lamé parameter: resistance to change of volume"}},
      {&StableNeoHookean::mu, {"mu", "μ", "Pa", "shear modulus (second Lamé parameter)", ParameterRange::positive}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {6.0, 3.4};
  static constexpr SmallStrainModuli sample = {1e3, 4e3 + 2e3 / 3};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{bulk - 2 * shear / 3, shear}; }
  static constexpr bool uses_I2 = false, uses_J = true, uses_I4 = false, has_volume_term = false;
  static constexpr bool always_valid = true;

  Mask<Real> valid(const Invariants<Real>&) const { return true; }

  Real energy(const Invariants<Real>& at) const {
    const Real dJ = at.J - 1;
    return Real(2.0 / 3) * mu * (at.I1 - 3 - natural_log((at.I1 + 1) / 4)) + (bulk() / 2 * dJ - mu) * dJ;
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    return {Real(2.0 / 3) * mu * at.I1 / (at.I1 + 1), 0, bulk() * (at.J - 1) - mu};
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    const Real i = 1 / (at.I1 + 1);
    return {Real(2.0 / 3) * mu * i * i, 0, 0, 0, 0, bulk()};
  }

 private:
  Real bulk() const { return lambda + Real(5.0 / 6) * mu; }
};

}  // namespace heml
