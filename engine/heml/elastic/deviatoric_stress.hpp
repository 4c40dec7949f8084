#pragma once
// Deviatoric principal stresses of isotropic laws, which decide on plastic flow.
#include <cmath>
#include <heml/materials/law.hpp>
#include <heml/materials/principal.hpp>

namespace heml {

template <class Real>
struct DeviatoricStress {
  Real tau[3] = {0, 0, 0};             ///< principal Kirchhoff stresses less their mean, Pa
  Real slope[3][3] = {{0}, {0}, {0}};  ///< ∂τ_i/∂ε_j by the principal logarithmic strains ε_j = ln(c_j)/2, Pa

  Real norm() const { return std::sqrt(tau[0] * tau[0] + tau[1] * tau[1] + tau[2] * tau[2]); }
};

template <class Real>
DeviatoricStress<Real> less_its_mean(DeviatoricStress<Real> stress) {
  const auto subtract_mean = [](Real& a, Real& b, Real& c) {
    const Real mean = (a + b + c) / 3;
    a -= mean, b -= mean, c -= mean;
  };
  subtract_mean(stress.tau[0], stress.tau[1], stress.tau[2]);
  for (int j = 0; j < 3; ++j) subtract_mean(stress.slope[0][j], stress.slope[1][j], stress.slope[2][j]);
  return stress;
}

/// At eigenvalues c of C, J as well. Without the part of fibres.
template <class Real, PrincipalLaw<Real> L>
DeviatoricStress<Real> deviatoric_stress(const L& law, const Real c[3], Real J) {
  const auto v = volume_powers<L::is_continued>(J);
  DeviatoricStress<Real> stress;
  for (int i = 0; i < 3; ++i) {
    const PrincipalDerivatives<Real> h = law.principal(v.p * c[i]);
    stress.tau[i] = 2 * v.p * c[i] * h.h1;
    const Real by_log = 2 * v.p * c[i] * (h.h1 + v.p * c[i] * h.h2);  // of c̄_i
    for (int j = 0; j < 3; ++j) stress.slope[i][j] = by_log * ((i == j ? 2 : 0) + v.p1 / v.p * J);
  }
  return less_its_mean(stress);
}

template <class Real, InvariantLaw<Real> L>
DeviatoricStress<Real> deviatoric_stress(const L& law, const Real c[3], Real J) {
  const Real I1 = c[0] + c[1] + c[2], I2 = c[0] * c[1] + c[0] * c[2] + c[1] * c[2];
  const FirstDerivatives<Real> w = law.first_derivatives({I1, I2, J});
  const SecondDerivatives<Real> ww = law.second_derivatives({I1, I2, J});
  DeviatoricStress<Real> stress;
  for (int i = 0; i < 3; ++i) {
    const Real pull = 2 * (w.w1 + w.w2 * (I1 - c[i]));
    stress.tau[i] = c[i] * pull;
    for (int j = 0; j < 3; ++j) {
      const Real dI1 = 2 * c[j], dI2 = dI1 * (I1 - c[j]);
      const Real dw1 = ww.w11 * dI1 + ww.w12 * dI2 + ww.w1J * J, dw2 = ww.w12 * dI1 + ww.w22 * dI2 + ww.w2J * J;
      stress.slope[i][j] =
          2 * c[i] * (dw1 + dw2 * (I1 - c[i]) + (i == j ? 0 : w.w2 * dI1)) + (i == j ? 2 * c[i] * pull : 0);
    }
  }
  return less_its_mean(stress);
}

}  // namespace heml
