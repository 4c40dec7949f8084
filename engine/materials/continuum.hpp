#pragma once
// A law seen from a deformation gradient: energy, first Piola–Kirchhoff stress, and its differential. The engine itself
// works in tension form (elastic/); this form serves `heml probe`, fields for viewers, and checks.
#include <heml/materials/law.hpp>
#include <heml/math/types.hpp>

namespace heml {

template <class Real>
Invariants<Real> invariants_of(const Matrix3<Real>& F) {
  const Matrix3<Real> C = F.transpose() * F;
  const Real I1 = C.trace();
  return {I1, (I1 * I1 - C.squaredNorm()) / 2, F.col(0).dot(F.col(1).cross(F.col(2)))};
}

/// P = ∂W/∂F, Pa: 2 (w1 + w2 I1) F − 2 w2 F C + wJ cof F.
template <class Real, Law<Real> L>
Matrix3<Real> first_piola(const L& law, const Matrix3<Real>& F) {
  const Invariants<Real> at = invariants_of(F);
  const Slopes<Real> s = law.slopes(at);
  Matrix3<Real> P = 2 * (s.w1 + s.w2 * at.I1) * F;
  if constexpr (L::uses_I2) P -= 2 * s.w2 * F * (F.transpose() * F);
  if constexpr (L::uses_J) P += s.wJ * cofactor(F);
  return P;
}

/// ∂P/∂F : dF, Pa.
template <class Real, Law<Real> L>
Matrix3<Real> first_piola_differential(const L& law, const Matrix3<Real>& F, const Matrix3<Real>& dF) {
  const Invariants<Real> at = invariants_of(F);
  const Slopes<Real> s = law.slopes(at);
  const Curvatures<Real> c = law.curvatures(at);
  const Matrix3<Real> C = F.transpose() * F, dC = dF.transpose() * F + F.transpose() * dF;
  const Matrix3<Real> cof = cofactor(F);
  const Real dI1 = dC.trace(), dI2 = at.I1 * dI1 - C.cwiseProduct(dC).sum(), dJ = cof.cwiseProduct(dF).sum();
  const Real dw1 = c.w11 * dI1 + c.w12 * dI2 + c.w1J * dJ;
  const Real dw2 = c.w12 * dI1 + c.w22 * dI2 + c.w2J * dJ;
  const Real dwJ = c.w1J * dI1 + c.w2J * dI2 + c.wJJ * dJ;
  // d(cof F): each column is a cross product of two others.
  Matrix3<Real> dcof;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    dcof.col(i) = dF.col(j).cross(F.col(k)) + F.col(j).cross(dF.col(k));
  }
  return 2 * (s.w1 + s.w2 * at.I1) * dF - 2 * s.w2 * (dF * C + F * dC) + s.wJ * dcof +
         2 * (dw1 + dw2 * at.I1 + s.w2 * dI1) * F - 2 * dw2 * F * C + dwJ * cof;
}

}  // namespace heml
