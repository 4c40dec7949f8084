#pragma once
// Arruda & Boyce, chains along the eight half diagonals of a cube: W = μ Σ Ci λm^(2−2i) (Ī1^i − 3^i) + κ/2 (J−1)², with
// five terms of the inverse Langevin function. λm is the locking stretch of a chain; the truncated series is a
// polynomial, so W stays finite at Ī1 = 3 λm² and beyond.
#include <heml/materials/isochoric.hpp>

namespace heml {

template <class Real, bool continued>
struct ArrudaBoyce : IsochoricLaw<ArrudaBoyce<Real, continued>, Real, continued> {
  Real mu, lambda_m, kappa;

  static constexpr std::string_view name = "arruda_boyce";
  static constexpr std::string_view title = "Arruda-Boyce, eight chains";
  static constexpr std::string_view formula = "μ Σ Ci λm^(2−2i) (Ī1^i − 3^i) + κ/2 (J−1)², i = 1 to 5";
  static constexpr std::string_view source = "Arruda & Boyce 1993";
  static constexpr Parameter<ArrudaBoyce, Real> parameters[] = {
      {&ArrudaBoyce::mu,
       {"mu", "μ", "Pa", "stiffness: the shear modulus at rest of long chains", ParameterRange::positive}},
      {&ArrudaBoyce::lambda_m,
       {"lambda_m", "λm", "", "stretch at which the chains are straight", ParameterRange::positive, 3}},
      {&ArrudaBoyce::kappa,
       {"kappa", "κ", "Pa", "bulk modulus: resistance to change of volume", ParameterRange::positive}},
  };
  static constexpr bool uses_I2 = false;
  static constexpr ForceCost cost = {13.5, 6.3};
  static constexpr auto of_moduli(double shear, double bulk) {
    constexpr double u = 3.0 / 4;  // at rest, with λm = 2
    return std::array{shear / (2 * slope(u)), 2.0, bulk};
  }

  /// In u = Ī1/λm², which is 3 (chain stretch / λm)².
  IsochoricPart<Real> part(Real a, Real) const {
    const Real t = 1 / (lambda_m * lambda_m), u = a * t;
    return {mu / t * (value(u) - value(3 * t)), mu * slope(u), 0, mu * t * curvature(u)};
  }

 private:
  /// Σ Ci u^i and its first two derivatives.
  template <class T>
  static constexpr T value(T u) {
    return u * (T(C[0]) + u * (T(C[1]) + u * (T(C[2]) + u * (T(C[3]) + u * T(C[4])))));
  }
  template <class T>
  static constexpr T slope(T u) {
    return T(C[0]) + u * (T(2 * C[1]) + u * (T(3 * C[2]) + u * (T(4 * C[3]) + u * T(5 * C[4]))));
  }
  template <class T>
  static constexpr T curvature(T u) {
    return T(2 * C[1]) + u * (T(6 * C[2]) + u * (T(12 * C[3]) + u * T(20 * C[4])));
  }
  static constexpr double C[] = {1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};
};

}  // namespace heml
