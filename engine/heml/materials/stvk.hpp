#pragma once
// Saint Venant–Kirchhoff: W = λ/2 tr(E)² + μ tr(E²) (paper, Table 1). With tr E = (I1−3)/2 and
// tr E² = (I1² − 2 I2 − 2 I1 + 3)/4 it depends on I1 and I2 alone.
//
// The law loses all stiffness under compression: the force of a flattened element falls to zero (paper, 2.3).
// `continued` adds ½ κ (J1 − J)² below J1 = 1/√3, κ = λ + 2μ, which restores inverted elements and keeps the force
// monotone under confined compression.
#include <cmath>
#include <heml/materials/law.hpp>

namespace heml {

template <class Real, bool continued>
struct StVK {
  Real lambda, mu;

  static constexpr std::string_view name = "stvk";
  static constexpr std::string_view title = "Saint Venant-Kirchhoff";
  static constexpr std::string_view formula = "λ/2 tr(E)² + μ tr(E²), E = (C − I)/2";
  static constexpr std::string_view source = "Goulette & Chendeb 2006, Table 1";
  static constexpr Parameter<StVK, Real> parameters[] = {
      {&StVK::lambda, {"lambda", "λ", "Pa", "first Lamé parameter: resistance to change of volume"}},
      {&StVK::mu, {"mu", "μ", "Pa", "shear modulus (second Lamé parameter)", ParameterRange::positive}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {5.8, 3.3};
  static constexpr SmallStrainModuli sample = {1e3, 1.5e3 + 2e3 / 3};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{bulk - 2 * shear / 3, shear}; }
  static constexpr bool uses_I2 = true;
  static constexpr bool uses_J = continued;
  static constexpr bool uses_I4 = false, has_volume_term = false;
  static constexpr bool always_valid = true;
  static constexpr Real J1 = Real(0.57735026918962576);

  Mask<Real> valid(const Invariants<Real>&) const { return true; }

  Real energy(const Invariants<Real>& at) const {
    const Real e = at.I1 - 3;
    const Real W = lambda / 8 * e * e + mu / 4 * (at.I1 * at.I1 - 2 * at.I2 - 2 * at.I1 + 3);
    if constexpr (!continued) return W;
    const Real depth = J1 - at.J;
    return W + select(depth > 0, (lambda + 2 * mu) / 2 * depth * depth, Real(0));
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const Real depth = J1 - at.J;
    return {lambda / 4 * (at.I1 - 3) + mu / 2 * (at.I1 - 1), -mu / 2,
            continued ? select(depth > 0, -(lambda + 2 * mu) * depth, Real(0)) : Real(0)};
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    return {lambda / 4 + mu / 2, 0, 0, 0, 0, continued ? select(at.J < J1, lambda + 2 * mu, Real(0)) : Real(0)};
  }
};

}  // namespace heml
