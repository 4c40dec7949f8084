#pragma once
// Veronda & Westmann, for skin: W = c1 (exp(β(Ī1−3)) − 1) − c1 β/2 (Ī2−3) + κ/2 (J−1)². `continued` replaces the
// exponential as in fung_demiray.hpp.
#include <heml/materials/autodiff_law.hpp>

namespace heml {

template <class Real, bool continued>
struct VerondaWestmann : AutodiffLaw<VerondaWestmann<Real, continued>, Real, continued> {
  using Base = AutodiffLaw<VerondaWestmann, Real, continued>;
  Real c1, beta, kappa;

  static constexpr std::string_view name = "veronda_westmann";
  static constexpr std::string_view title = "Veronda-Westmann";
  static constexpr std::string_view formula = "c1 (exp(β(Ī1−3)) − 1) − c1 β/2 (Ī2−3) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Veronda & Westmann 1970";
  static constexpr Parameter<VerondaWestmann, Real> parameters[] = {
      {&VerondaWestmann::c1,
       {"c1", "c1", "Pa", "stiffness; the shear modulus at rest is c1 β", ParameterRange::positive}},
      {&VerondaWestmann::beta,
       {"beta", "β", "", "how fast the tissue stiffens when stretched", ParameterRange::positive, 1,
        ParameterKind::exponent}},
      {&VerondaWestmann::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {32.0, 13.6};
  static constexpr SmallStrainModuli sample = {900, 5e4};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear / 3, 3.0, bulk}; }

  Mask<Real> valid(const Invariants<Real>& at) const {
    return Base::valid(at) && (continued || beta * (isochoric<continued>(at).I1 - 3) < safe_exponent<Real>);
  }

  template <class T>
  T density(const Invariants<T>& at) const {
    const auto bar = isochoric<continued>(at);
    const T Q = T(beta) * (bar.I1 - T(3)), Q0(9.210340371976184), dJ = at.J - T(1);
    const T c = continued ? select(Q > Q0, Q0, Q) : Q, d = Q - c;
    const T exp_minus_one = natural_expm1(c);
    return T(c1) * (exp_minus_one + (exp_minus_one + T(1)) * d * (T(1) + d * T(0.5))) -
           T(c1 * beta / 2) * (bar.I2 - T(3)) + T(kappa / 2) * dJ * dJ;
  }
};

}  // namespace heml
