#pragma once
// The energies of the paper's Table 1 as printed, misprints corrected: in I1 and I2, not in Ī1 and Ī2. They are not
// stress-free at rest: a body shrinks until its volume term balances that stress. For comparison only; otherwise use
// neo_hookean_iso, mooney_rivlin and fung_demiray.
#include <heml/materials/fung_demiray.hpp>

namespace heml {

/// Base class: W = w(I1, I2) + κ/2 (J−1)², with the volume term of the paper's section 2.3.
template <class Self, class Real, bool continued>
struct PaperLaw {
  static constexpr std::string_view source = "Goulette & Chendeb 2006, Table 1, as printed";
  static constexpr bool has_volume_term = true, uses_J = true, uses_I4 = false;
  static constexpr bool always_valid = true, is_stress_free = false;
  static constexpr SmallStrainModuli sample = {1e3, 5e4};

  Mask<Real> valid(const Invariants<Real>&) const { return true; }
  Real energy(const Invariants<Real>& at) const {
    return self().part(at.I1, at.I2).w + self().kappa / 2 * (at.J - 1) * (at.J - 1);
  }
  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const auto w = self().part(at.I1, at.I2);
    return {w.a, w.b, self().kappa * (at.J - 1)};
  }
  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    return {self().part(at.I1, at.I2).aa, 0, 0, 0, 0, self().kappa};
  }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

template <class Real, bool continued>
struct PaperNeoHookean : PaperLaw<PaperNeoHookean<Real, continued>, Real, continued> {
  Real K1, kappa;

  static constexpr std::string_view name = "paper_neo_hookean";
  static constexpr std::string_view title = "Neo-Hookean as printed";
  static constexpr std::string_view formula = "K1 (I1−3) + κ/2 (J−1)²";
  static constexpr Parameter<PaperNeoHookean, Real> parameters[] = {
      {&PaperNeoHookean::K1, {"K1", "K1", "Pa", "half the shear modulus", ParameterRange::positive}},
      {&PaperNeoHookean::kappa, {"kappa", "κ", "Pa", "penalty of a change of volume", ParameterRange::not_negative}},
  };
  static constexpr ForceCost cost = {5.2, 3.0};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear / 2, bulk}; }
  static constexpr bool uses_I2 = false;
  IsochoricPart<Real> part(Real I1, Real) const { return {K1 * (I1 - 3), K1, 0}; }
};

template <class Real, bool continued>
struct PaperMooneyRivlin : PaperLaw<PaperMooneyRivlin<Real, continued>, Real, continued> {
  Real K1, K2, kappa;

  static constexpr std::string_view name = "paper_mooney_rivlin";
  static constexpr std::string_view title = "Mooney-Rivlin as printed";
  static constexpr std::string_view formula = "K1 (I1−3) + K2 (I2−3) + κ/2 (J−1)²";
  static constexpr Parameter<PaperMooneyRivlin, Real> parameters[] = {
      {&PaperMooneyRivlin::K1, {"K1", "K1", "Pa", "first Mooney constant", ParameterRange::positive}},
      {&PaperMooneyRivlin::K2, {"K2", "K2", "Pa", "second Mooney constant", ParameterRange::any, 0.25}},
      {&PaperMooneyRivlin::kappa, {"kappa", "κ", "Pa", "penalty of a change of volume", ParameterRange::not_negative}},
  };
  static constexpr ForceCost cost = {6.7, 3.8};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{0.4 * shear, 0.1 * shear, bulk}; }
  static constexpr bool uses_I2 = true;
  IsochoricPart<Real> part(Real I1, Real I2) const { return {K1 * (I1 - 3) + K2 * (I2 - 3), K1, K2}; }
};

template <class Real, bool continued>
struct PaperFungDemiray : PaperLaw<PaperFungDemiray<Real, continued>, Real, continued> {
  Real mu, gamma, kappa;

  static constexpr std::string_view name = "paper_fung_demiray";
  static constexpr std::string_view title = "Fung & Demiray as printed";
  static constexpr std::string_view formula = "μ/(2γ) (exp(γ(I1−3)) − 1) + κ/2 (J−1)²";
  static constexpr Parameter<PaperFungDemiray, Real> parameters[] = {
      {&PaperFungDemiray::mu, {"mu", "μ", "Pa", "shear modulus", ParameterRange::positive}},
      {&PaperFungDemiray::gamma,
       {"gamma", "γ", "", "how fast the tissue stiffens when stretched", ParameterRange::positive, 1,
        ParameterKind::exponent}},
      {&PaperFungDemiray::kappa, {"kappa", "κ", "Pa", "penalty of a change of volume", ParameterRange::not_negative}},
  };
  static constexpr ForceCost cost = {8.6, 4.3};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear, 1.5, bulk}; }
  static constexpr bool uses_I2 = false, always_valid = continued;
  Mask<Real> valid(const Invariants<Real>& at) const { return continued || gamma * (at.I1 - 3) < safe_exponent<Real>; }
  IsochoricPart<Real> part(Real I1, Real) const {
    const auto e = bounded_exp<continued>(gamma * (I1 - 3));
    return {mu / (2 * gamma) * e.exp_minus_one, mu / 2 * e.first, 0, mu / 2 * gamma * e.second};
  }
};

}  // namespace heml
