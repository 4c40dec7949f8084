#pragma once
// Yeoh: W = C10 (Ī1−3) + C20 (Ī1−3)² + C30 (Ī1−3)³ + κ/2 (J−1)².
#include <heml/materials/autodiff_law.hpp>

namespace heml {

template <class Real, bool continued>
struct Yeoh : AutodiffLaw<Yeoh<Real, continued>, Real, continued> {
  Real C10, C20, C30, kappa;

  static constexpr std::string_view name = "yeoh";
  static constexpr std::string_view title = "Yeoh";
  static constexpr std::string_view formula = "C10 (Ī1−3) + C20 (Ī1−3)² + C30 (Ī1−3)³ + κ/2 (J−1)²";
  static constexpr std::string_view source = "Yeoh 1993";
  static constexpr Parameter<Yeoh, Real> parameters[] = {
      {&Yeoh::C10, {"C10", "C10", "Pa", "half the shear modulus at rest", ParameterRange::positive}},
      {&Yeoh::C20, {"C20", "C20", "Pa", "second coefficient", ParameterRange::any, 0}},
      {&Yeoh::C30, {"C30", "C30", "Pa", "third coefficient: stiffening at large stretches", ParameterRange::any, 0}},
      {&Yeoh::kappa, {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {23.2, 9.9};
  static constexpr auto of_moduli(double shear, double bulk) {
    return std::array{shear / 2, -0.05 * shear, 0.08 * shear, bulk};
  }

  template <class T>
  T density(const Invariants<T>& at) const {
    const T e = isochoric<continued>(at).I1 - T(3), dJ = at.J - T(1);
    return e * (T(C10) + e * (T(C20) + e * T(C30))) + T(kappa / 2) * dJ * dJ;
  }
};

}  // namespace heml
