#pragma once
// Neo-Hookean with a separate volume term: W = K1 (Ī1−3) + κ/2 (J−1)². The paper's Table 1 with the isochoric
// invariant, so that it is stress-free at rest.
#include <heml/materials/isochoric.hpp>

namespace heml {

template <class Real, bool continued>
struct NeoHookeanIso : IsochoricLaw<NeoHookeanIso<Real, continued>, Real, continued> {
  Real K1, kappa;

  static constexpr std::string_view name = "neo_hookean_iso";
  static constexpr std::string_view title = "Neo-Hookean, isochoric";
  static constexpr std::string_view formula = "K1 (Ī1−3) + κ/2 (J−1)²";
  static constexpr std::string_view source = "Goulette & Chendeb 2006, Table 1, with Ī1 for I1";
  static constexpr Parameter<NeoHookeanIso, Real> parameters[] = {
      {&NeoHookeanIso::K1, {"K1", "K1", "Pa", "half the shear modulus", ParameterRange::positive}},
      {&NeoHookeanIso::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr ForceCost cost = {12.2, 5.7};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear / 2, bulk}; }
  static constexpr bool uses_I2 = false;

  IsochoricPart<Real> part(Real a, Real) const { return {K1 * (a - 3), K1, 0}; }
};

}  // namespace heml
