#pragma once
// Fung & Demiray: W = μ/(2γ) (exp(γ(Ī1−3)) − 1) + κ/2 (J−1)². (The paper's Table 1 prints exp(γ(I1−3) − 1), which is
// too small by a factor e.)
//
// The exponential overflows at large stretches. `continued` replaces it above γ(Ī1−3) = Q0 by its second-order Taylor
// polynomial: C2, and the tangent stays below 1e4 times that at rest.
#include <heml/materials/isochoric.hpp>

namespace heml {

template <class Real>
struct ExponentialValue {
  Real exp_minus_one, first, second;  ///< exp(Q) − 1, first and second derivative
};

/// exp(Q) and its first two derivatives, continued above Q0 = ln 1e4.
template <bool continued, class Real>
[[gnu::always_inline]] inline ExponentialValue<Real> bounded_exp(Real Q) {
  constexpr Real Q0 = Real(9.210340371976184);
  const Real c = continued ? select(Q < Q0, Q, Q0) : Q;
  const Real exp_minus_one = natural_expm1(c), e = exp_minus_one + 1;
  if constexpr (!continued) return {exp_minus_one, e, e};
  const Real d = Q - c;
  return {exp_minus_one + e * d * (1 + d / 2), e * (1 + d), e};
}

template <class Real, bool continued>
struct FungDemiray : IsochoricLaw<FungDemiray<Real, continued>, Real, continued> {
  using Base = IsochoricLaw<FungDemiray, Real, continued>;
  Real mu, gamma, kappa;

  static constexpr std::string_view name = "fung_demiray";
  static constexpr std::string_view title = "Fung & Demiray";
  static constexpr std::string_view formula = "μ/(2γ) (exp(γ(Ī1−3)) − 1) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Fung 1967; Demiray 1972; Goulette & Chendeb 2006, Table 1";
  static constexpr Parameter<FungDemiray, Real> parameters[] = {
      {&FungDemiray::mu, {"mu", "μ", "Pa", "shear modulus at rest", ParameterRange::positive}},
      {&FungDemiray::gamma,
       {"gamma", "γ", "", "how fast the tissue stiffens when stretched", ParameterRange::positive, 1,
        ParameterKind::exponent}},
      {&FungDemiray::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {17.4, 7.3};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear, 1.5, bulk}; }
  static constexpr bool uses_I2 = false;

  Mask<Real> valid(const Invariants<Real>& at) const {
    return Base::valid(at) && (continued || gamma * (volume_powers<continued>(at.J).p * at.I1 - 3) <
                                                safe_exponent<Real>);  // stress and stiffness must not overflow either
  }

  IsochoricPart<Real> part(Real a, Real) const {
    const auto e = bounded_exp<continued>(gamma * (a - 3));
    return {mu / (2 * gamma) * e.exp_minus_one, mu / 2 * e.first, 0, mu / 2 * gamma * e.second};
  }
};

}  // namespace heml
