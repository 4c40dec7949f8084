#pragma once
// One family of fibres in a neo-Hookean matrix, after Holzapfel, Gasser and Ogden: W = K1 (Ī1−3) + κ/2 (J−1)² +
// k1/(2 k2) (exp(k2 (Ī4−1)²) − 1) where Ī4 > 1; Ī4 = J^(−2/3) a0·C a0. Fibres bear no compression.
#include <heml/materials/fung_demiray.hpp>
#include <heml/materials/neo_hookean_iso.hpp>
#include <limits>

namespace heml {

template <class Real, bool continued>
struct Hgo {
  Real K1, kappa, k1, k2;

  static constexpr std::string_view name = "hgo";
  static constexpr std::string_view title = "Holzapfel-Gasser-Ogden fibres";
  static constexpr std::string_view formula = "K1 (Ī1−3) + κ/2 (J−1)² + k1/(2 k2) (exp(k2 (Ī4−1)²) − 1) where Ī4 > 1";
  static constexpr std::string_view source = "Holzapfel, Gasser & Ogden 2000";
  static constexpr Parameter<Hgo, Real> parameters[] = {
      {&Hgo::K1, {"K1", "K1", "Pa", "half the shear modulus of the matrix", ParameterRange::positive}},
      {&Hgo::kappa, {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
      {&Hgo::k1, {"k1", "k1", "Pa", "stiffness of the fibres", ParameterRange::positive}},
      {&Hgo::k2, {"k2", "k2", "", "how fast the fibres stiffen", ParameterRange::positive, 1, ParameterKind::exponent}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {20.3, 8.6};
  static constexpr SmallStrainModuli sample = {1e3, 5e4};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear / 2, bulk, 0.8 * shear, 2.0}; }
  static constexpr bool has_volume_term = true, uses_I2 = false, uses_J = true, uses_I4 = true;
  static constexpr bool always_valid = continued;

  Mask<Real> valid(const Invariants<Real>& at) const {
    if constexpr (continued) return true;
    const Real stretch = volume_powers<continued>(at.J).p * at.I4 - 1;
    return matrix().valid(at) && !(stretch > 0 && k2 * stretch * stretch > safe_exponent<Real>);
  }

  Real energy(const Invariants<Real>& at) const {
    return matrix().energy(at) + fibre(volume_powers<continued>(at.J).p * at.I4).w;
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    FirstDerivatives<Real> s = matrix().first_derivatives(at);
    const auto v = volume_powers<continued>(at.J);
    const auto f = fibre(v.p * at.I4);
    s.wJ += f.w1 * v.p1 * at.I4;
    s.w4 = f.w1 * v.p;
    return s;
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    SecondDerivatives<Real> c = matrix().second_derivatives(at);
    const auto v = volume_powers<continued>(at.J);
    const auto f = fibre(v.p * at.I4);
    c.w44 = f.w2 * v.p * v.p;
    c.w4J = f.w1 * v.p1 + f.w2 * v.p * v.p1 * at.I4;
    c.wJJ += f.w1 * v.p2 * at.I4 + f.w2 * v.p1 * at.I4 * v.p1 * at.I4;
    return c;
  }

 private:
  NeoHookeanIso<Real, continued> matrix() const { return {{}, K1, kappa}; }

  struct Fibre {
    Real w, w1, w2;  ///< by Ī4
  };
  Fibre fibre(Real i4) const {
    // The margin keeps fibres inactive where Ī4 is 1 up to round-off.
    const Mask<Real> bears = i4 > 1 + 32 * std::numeric_limits<Real>::epsilon();
    const Real s = select(bears, i4 - 1, Real(0));  // inactive: w = w1 = 0; w2 = 0 by `on`
    const auto e = bounded_exp<continued>(k2 * s * s);
    const Real on = select(bears, k1, Real(0));
    return {k1 / (2 * k2) * e.exp_minus_one, k1 * s * e.first, on * (e.first + 2 * k2 * s * s * e.second)};
  }
};

}  // namespace heml
