#pragma once
// Guccione's law of heart muscle: W = C/2 (exp(Q) − 1) + κ/2 (J−1)² with
//   Q = bf Ē11² + bt (Ē22² + Ē33² + 2 Ē23²) + bfs (2 Ē12² + 2 Ē13²),   Ē = (C̄ − I)/2,   C̄ = J^(−2/3) C,
// the fibre along axis 1. Guccione, McCulloch & Waldman (1991) have an incompressible material, where C̄ is C itself; a
// compressible one keeps shape and volume apart so. With e = a0·Ē a0 and s = |Ē a0|² it needs no axes:
//   Q = bt tr Ē² + (bf + bt − 2 bfs) e² + 2 (bfs − bt) s
//   tr Ē² = (Ī1² − 2 Ī2 − 2 Ī1 + 3)/4,   e = (Ī4 − 1)/2,   s = (Ī5 − 2 Ī4 + 1)/4
// with Ī1 = p I1, Ī2 = p² I2, Ī4 = p I4, Ī5 = p² I5 and p = J^(−2/3).
//
// `continued` bounds the exponential (bounded_exp) and continues p below J0 (materials/volume.hpp).
#include <heml/materials/fung_demiray.hpp>

namespace heml {

template <class Real, bool continued>
struct Guccione {
  Real C, bf, bt, bfs, kappa;

  static constexpr std::string_view name = "guccione";
  static constexpr std::string_view title = "Guccione";
  static constexpr std::string_view formula =
      "C/2 (exp(bf Ē11² + bt (Ē22² + Ē33² + 2 Ē23²) + bfs (2 Ē12² + 2 Ē13²)) − 1) + κ/2 (J−1)², Ē = (J^(−2/3) C − I)/2";
  static constexpr std::string_view source = "Guccione, McCulloch & Waldman 1991";
  static constexpr Parameter<Guccione, Real> parameters[] = {
      {&Guccione::C, {"C", "C", "Pa", "scale of the stress", ParameterRange::positive}},
      {&Guccione::bf,
       {"bf", "b_f", "", "stiffness along the fibres, over C", ParameterRange::positive, 8, ParameterKind::exponent}},
      {&Guccione::bt,
       {"bt", "b_t", "", "stiffness across the fibres, over C", ParameterRange::positive, 2, ParameterKind::exponent}},
      {&Guccione::bfs,
       {"bfs", "b_fs", "", "stiffness against shear along the fibres, over C", ParameterRange::positive, 4,
        ParameterKind::exponent}},
      {&Guccione::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr bool is_stress_free = true;
  static constexpr ForceCost cost = {26, 11};
  static constexpr SmallStrainModuli sample = {1e3, 5e4};
  static constexpr auto of_moduli(double shear, double bulk) { return std::array{shear, 8.0, 2.0, 4.0, bulk}; }
  static constexpr bool has_volume_term = true, uses_I2 = true, uses_J = true, uses_I4 = true, uses_I5 = true;
  static constexpr bool always_valid = continued;

  Mask<Real> valid(const Invariants<Real>& at) const {
    if constexpr (continued) return true;
    const Mask<Real> has_volume = at.J > min_volume_ratio<Real> || at.J < -min_volume_ratio<Real>;
    return has_volume && exponent(at, volume_powers<continued>(at.J).p) < safe_exponent<Real>;
  }

  Real energy(const Invariants<Real>& at) const {
    const Real Q = exponent(at, volume_powers<continued>(at.J).p);
    return C / 2 * bounded_exp<continued>(Q).exp_minus_one + kappa / 2 * (at.J - 1) * (at.J - 1);
  }

  FirstDerivatives<Real> first_derivatives(const Invariants<Real>& at) const {
    const auto v = volume_powers<continued>(at.J);
    const Real f = C / 2 * bounded_exp<continued>(exponent(at, v.p)).first;
    const Slopes q = slopes(at, v.p);
    return {f * q.by1, f * q.by2, f * q.by_p * v.p1 + kappa * (at.J - 1), f * q.by4, f * q.by5};
  }

  SecondDerivatives<Real> second_derivatives(const Invariants<Real>& at) const {
    const auto v = volume_powers<continued>(at.J);
    const auto e = bounded_exp<continued>(exponent(at, v.p));
    const Real f = C / 2 * e.first, g = C / 2 * e.second, along = along_fibre(), shear = fibre_shear(), p = v.p;
    const Slopes q = slopes(at, p);
    const Real qJ = q.by_p * v.p1, fp = f * v.p1, pp = f / 2 * p * p;
    const Real by_pp = (bt * (at.I1 * at.I1 - 2 * at.I2) + along * at.I4 * at.I4 + shear * at.I5) / 2;
    SecondDerivatives<Real> c;
    c.w11 = g * q.by1 * q.by1 + bt * pp;
    c.w12 = g * q.by1 * q.by2;
    c.w22 = g * q.by2 * q.by2;
    c.w14 = g * q.by1 * q.by4;
    c.w24 = g * q.by2 * q.by4;
    c.w44 = g * q.by4 * q.by4 + along * pp;
    c.w15 = g * q.by1 * q.by5;
    c.w25 = g * q.by2 * q.by5;
    c.w45 = g * q.by4 * q.by5;
    c.w55 = g * q.by5 * q.by5;
    c.w1J = g * q.by1 * qJ + fp * bt / 2 * (2 * p * at.I1 - 1);
    c.w2J = g * q.by2 * qJ - fp * bt * p;
    c.w4J = g * q.by4 * qJ + fp / 2 * (along * (2 * p * at.I4 - 1) - shear);
    c.w5J = g * q.by5 * qJ + fp / 2 * shear * p;
    c.wJJ = g * qJ * qJ + fp * by_pp * v.p1 + f * q.by_p * v.p2 + kappa;
    return c;
  }

 private:
  Real along_fibre() const { return bf + bt - 2 * bfs; }  ///< factor of e²
  Real fibre_shear() const { return 2 * (bfs - bt); }     ///< factor of s

  Real exponent(const Invariants<Real>& at, Real p) const {
    const Real I1 = p * at.I1, I4 = p * at.I4, e = I4 - 1;
    const Real square = I1 * I1 - 2 * p * p * at.I2 - 2 * I1 + 3;  // 4 tr Ē²
    return (bt * square + along_fibre() * e * e + fibre_shear() * (p * p * at.I5 - 2 * I4 + 1)) / 4;
  }

  /// Derivatives of Q by I1, I2, I4, I5 and p.
  struct Slopes {
    Real by1, by2, by4, by5, by_p;
  };
  Slopes slopes(const Invariants<Real>& at, Real p) const {
    const Real along = along_fibre(), shear = fibre_shear(), e = p * at.I4 - 1;
    const Real by_p = bt * (p * (at.I1 * at.I1 - 2 * at.I2) - at.I1) + along * at.I4 * e + shear * (p * at.I5 - at.I4);
    return {bt / 2 * p * (p * at.I1 - 1), -bt / 2 * p * p, p / 2 * (along * e - shear), shear / 4 * p * p, by_p / 2};
  }
};

}  // namespace heml
