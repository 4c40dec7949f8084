#pragma once
// Gent, chains of limited extensibility: W = −μ Jm/2 ln(1 − (Ī1−3)/Jm) + κ/2 (J−1)², defined for Ī1 − 3 < Jm.
// `continued` replaces the logarithm above 0.95 Jm by its second-order Taylor polynomial: C2.
#include <heml/materials/autodiff_law.hpp>

namespace heml {

template <class Real, bool continued>
struct Gent : AutodiffLaw<Gent<Real, continued>, Real, continued> {
  using Base = AutodiffLaw<Gent, Real, continued>;
  Real mu, Jm, kappa;

  static constexpr std::string_view name = "gent";
  static constexpr std::string_view title = "Gent";
  static constexpr std::string_view formula = "−μ Jm/2 ln(1 − (Ī1−3)/Jm) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Gent 1996";
  static constexpr Parameter<Gent, Real> parameters[] = {
      {&Gent::mu, {"mu", "μ", "Pa", "shear modulus at rest", ParameterRange::positive}},
      {&Gent::Jm,
       {"Jm", "Jm", "", "value of Ī1−3 where the chains are straight and no further stretch is possible",
        ParameterRange::positive, 30, ParameterKind::limit}},
      {&Gent::kappa, {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {30.7, 13.2};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear, 20.0, bulk}; }

  Mask<Real> valid(const Invariants<Real>& at) const {
    return Base::valid(at) && (continued || isochoric<continued>(at).I1 - 3 < Real(0.999999) * Jm);
  }

  template <class T>
  T density(const Invariants<T>& at) const {
    const T s = (isochoric<continued>(at).I1 - T(3)) / T(Jm), s0(0.95), dJ = at.J - T(1);
    const T c = continued ? select(s > s0, s0, s) : s, room = T(1) - c, d = (s - c) / room;
    return T(mu * Jm / 2) * (d * (T(1) + d * T(0.5)) - natural_log(room)) + T(kappa / 2) * dJ * dJ;
  }
};

}  // namespace heml
