#pragma once
// Mooney–Rivlin: W = K1 (Ī1−3) + K2 (Ī2−3) + κ/2 (J−1)² (paper, Table 1, with isochoric invariants; the printed force
// drops the factor 2 of its K2 term).
#include <heml/materials/isochoric.hpp>

namespace heml {

template <class Real, bool continued>
struct MooneyRivlin : IsochoricLaw<MooneyRivlin<Real, continued>, Real, continued> {
  Real K1, K2, kappa;

  static constexpr std::string_view name = "mooney_rivlin";
  static constexpr std::string_view title = "Mooney-Rivlin";
  static constexpr std::string_view formula = "K1 (Ī1−3) + K2 (Ī2−3) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Mooney 1940; Rivlin 1948; Goulette & Chendeb 2006, Table 1";
  static constexpr Parameter<MooneyRivlin, Real> parameters[] = {
      {&MooneyRivlin::K1, {"K1", "K1", "Pa", "first Mooney constant; the shear modulus is 2 (K1 + K2)"}},
      {&MooneyRivlin::K2, {"K2", "K2", "Pa", "second Mooney constant", ParameterRange::any, 0.25}},
      {&MooneyRivlin::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {15.9, 7.1};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{0.4 * shear, 0.1 * shear, bulk}; }
  static constexpr bool uses_I2 = true;

  IsochoricPart<Real> part(Real a, Real b) const { return {K1 * (a - 3) + K2 * (b - 3), K1, K2}; }
};

}  // namespace heml
