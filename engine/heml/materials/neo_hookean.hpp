#pragma once
// Neo-Hookean with a logarithmic volume term: W = μ/2 (I1−3) − μ ln J + λ/2 (ln J)², J signed.
// (The paper's energy K1 I1 in Table 1 is not stress-free at rest; with the logarithm it is.)
//
// Defined for J > 0. `continued` replaces ln J and (ln J)² below J0 by their second-order Taylor polynomials at J0: C2,
// finite, and restoring through J = 0 and beyond.
#include <heml/materials/law.hpp>
#include <heml/materials/volume.hpp>
#include <heml/math/elementary.hpp>

namespace heml {

template <class Real, bool continued>
struct NeoHookean {
  Real lambda, mu;

  static constexpr std::string_view name = "neo_hookean";
  static constexpr std::string_view title = "Neo-Hookean";
  static constexpr std::string_view formula = "μ/2 (I1−3) − μ ln J + λ/2 (ln J)²";
  static constexpr std::string_view source = "Bonet & Wood 2008, 6.4.3";
  static constexpr Parameter<NeoHookean, Real> parameters[] = {
      {&NeoHookean::lambda, {"lambda", "λ", "Pa", "first Lamé parameter: resistance to change of volume"}},
      {&NeoHookean::mu, {"mu", "μ", "Pa", "shear modulus (second Lamé parameter)", ParameterRange::positive}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {7.9, 4.0};
  static constexpr SmallStrainModuli sample = {1e3, 4e3 + 2e3 / 3};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{bulk - 2 * shear / 3, shear}; }
  static constexpr bool uses_I2 = false;
  static constexpr bool uses_J = true;
  static constexpr bool uses_I4 = false, has_volume_term = false;
  static constexpr bool always_valid = continued;
  static constexpr Real J0 = Real(0.3);

  Mask<Real> valid(const Invariants<Real>& at) const { return continued || at.J > min_volume_ratio<Real>; }

  Real energy(const Invariants<Real>& at) const {
    const auto [d, l, c] = point(at.J);
    const Real log_J = l + (d / c) * (1 - d / c / 2);
    const Real log_J_squared = l * l + (d / c) * (2 * l + (1 - l) * (d / c));
    return mu / 2 * (at.I1 - 3) - mu * log_J + lambda / 2 * log_J_squared;
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const auto [d, l, c] = point(at.J);
    return {mu / 2, 0, (lambda * (l + (1 - l) * (d / c)) - mu * (1 - d / c)) / c};
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    const auto [d, l, c] = point(at.J);
    return {0, 0, 0, 0, 0, (lambda * (1 - l) + mu) / (c * c)};
  }

 private:
  struct Point {
    Real beyond;  ///< J − c; 0 above J0
    Real log_c;   ///< ln c
    Real c;       ///< expansion point of the polynomials: max(J, J0); J without continuation
  };
  static Point point(Real J) {
    if constexpr (!continued) return {0, natural_log(J), J};
    const Real c = select(J > J0, J, J0);
    return {J - c, natural_log(c), c};
  }
};

}  // namespace heml
