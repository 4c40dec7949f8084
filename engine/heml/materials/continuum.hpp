#pragma once
// Stress of any law from the deformation gradient: P = F S + wJ cof F with S = 2 ∂W/∂C at fixed J. For `heml probe`,
// the test bench, fields for viewers, and checks; the force loop uses tensions instead (elastic/tension.hpp).
#include <heml/materials/principal.hpp>
#include <heml/math/types.hpp>

namespace heml {

/// Strain measures that laws depend on: C (11 22 33 12 13 23), J and the fibre direction.
template <class Real>
struct Strain {
  Real C[6];
  Real J;
  Vector3<Real> fibre = Vector3<Real>::Zero();  ///< unit vector at rest; zero: none

  Invariants<Real> invariants() const {
    const Real I1 = C[0] + C[1] + C[2];
    return {I1, (I1 * I1 - double_contraction3(C, C)) / 2, J, bilinear3(fibre.data(), C, fibre.data()),
            times_fibre(C).squaredNorm()};
  }
  /// S a0 of a symmetric S.
  Vector3<Real> times_fibre(const Real S[6]) const {
    Vector3<Real> product;
    times3(S, fibre.data(), product.data());
    return product;
  }
};

template <class Real>
void to_symmetric6(const Matrix3<Real>& S, Real out[6]) {
  out[0] = S(0, 0), out[1] = S(1, 1), out[2] = S(2, 2), out[3] = S(0, 1), out[4] = S(0, 2), out[5] = S(1, 2);
}
template <class Real>
Matrix3<Real> from_symmetric6(const Real S[6]) {
  Matrix3<Real> M;
  M << S[0], S[3], S[4], S[3], S[1], S[5], S[4], S[5], S[2];
  return M;
}

template <class Real>
Strain<Real> strain_measures(const Matrix3<Real>& F, const Vector3<Real>& fibre) {
  Strain<Real> strain;
  to_symmetric6<Real>(F.transpose() * F, strain.C);
  strain.J = F.col(0).dot(F.col(1).cross(F.col(2)));
  strain.fibre = fibre;
  return strain;
}

/// a bᵀ + b aᵀ.
template <class Real>
Matrix3<Real> symmetric_product(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a * b.transpose() + b * a.transpose();
}

template <class Real, Law<Real> L>
Real energy_density(const L& law, const Strain<Real>& at) {
  if constexpr (PrincipalLaw<L, Real>)
    return principal_energy<L::is_continued>(law, at.C, at.J);
  else
    return law.energy(at.invariants());
}

template <class Real, Law<Real> L>
Stress<Real> stress_of(const L& law, const Strain<Real>& at) {
  if constexpr (PrincipalLaw<L, Real>) {
    return principal_stress(law, principal_state<L::is_continued>(law, at.C, at.J), at.J);
  } else {
    const auto i = at.invariants();
    const FirstDerivatives<Real> s = law.first_derivatives(i);
    Matrix3<Real> S = 2 * (s.w1 + s.w2 * i.I1) * Matrix3<Real>::Identity() - 2 * s.w2 * from_symmetric6(at.C) +
                      2 * s.w4 * at.fibre * at.fibre.transpose();
    if constexpr (FibreShearLaw<L>) S += 2 * s.w5 * symmetric_product<Real>(at.fibre, at.times_fibre(at.C));
    Stress<Real> stress;
    to_symmetric6(S, stress.S);
    stress.wJ = s.wJ;
    return stress;
  }
}

/// Change of S and wJ for changes dC and dJ, Pa.
template <class Real, Law<Real> L>
Stress<Real> stress_differential(const L& law, const Strain<Real>& at, const Real dC[6], Real dJ) {
  if constexpr (PrincipalLaw<L, Real>) {
    const auto state = principal_state<L::is_continued>(law, at.C, at.J);
    Real divided[6];
    divided_differences(law, state, divided);
    return principal_stress_differential(law, state, divided, dC, at.J, dJ);
  } else {
    const auto i = at.invariants();
    const FirstDerivatives<Real> s = law.first_derivatives(i);
    const SecondDerivatives<Real> c = law.second_derivatives(i);
    const Real dI1 = dC[0] + dC[1] + dC[2], dI2 = i.I1 * dI1 - double_contraction3(at.C, dC);
    const Real dI4 = bilinear3(at.fibre.data(), dC, at.fibre.data());
    Real dw1 = c.w11 * dI1 + c.w12 * dI2 + c.w1J * dJ + c.w14 * dI4;
    Real dw2 = c.w12 * dI1 + c.w22 * dI2 + c.w2J * dJ + c.w24 * dI4;
    Real dw4 = c.w14 * dI1 + c.w24 * dI2 + c.w4J * dJ + c.w44 * dI4;
    Matrix3<Real> of_I5 = Matrix3<Real>::Zero();
    Stress<Real> change;
    change.wJ = c.w1J * dI1 + c.w2J * dI2 + c.wJJ * dJ + c.w4J * dI4;
    if constexpr (FibreShearLaw<L>) {
      const Vector3<Real> Ca0 = at.times_fibre(at.C), dCa0 = at.times_fibre(dC);
      const Real dI5 = 2 * Ca0.dot(dCa0);
      const Real dw5 = c.w15 * dI1 + c.w25 * dI2 + c.w5J * dJ + c.w45 * dI4 + c.w55 * dI5;
      dw1 += c.w15 * dI5, dw2 += c.w25 * dI5, dw4 += c.w45 * dI5, change.wJ += c.w5J * dI5;
      of_I5 = 2 * symmetric_product<Real>(at.fibre, dw5 * Ca0 + s.w5 * dCa0);
    }
    Matrix3<Real> dS = 2 * (dw1 + dw2 * i.I1 + s.w2 * dI1) * Matrix3<Real>::Identity() -
                       2 * (dw2 * from_symmetric6(at.C) + s.w2 * from_symmetric6(dC)) +
                       2 * dw4 * at.fibre * at.fibre.transpose();
    if constexpr (FibreShearLaw<L>) dS += of_I5;
    to_symmetric6(dS, change.S);
    return change;
  }
}

/// P = ∂W/∂F, Pa.
template <class Real>
Matrix3<Real> first_piola(const Stress<Real>& stress, const Matrix3<Real>& F) {
  return F * from_symmetric6(stress.S) + stress.wJ * cofactor(F);
}

/// ∂P/∂F : dF, Pa, from the stress at F and its change (stress_differential()).
template <class Real>
Matrix3<Real> first_piola_change(const Stress<Real>& stress, const Stress<Real>& change, const Matrix3<Real>& F,
                                 const Matrix3<Real>& dF) {
  Matrix3<Real> dcof;  // change of cof F, whose columns are cross products of columns of F
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    dcof.col(i) = dF.col(j).cross(F.col(k)) + F.col(j).cross(dF.col(k));
  }
  return dF * from_symmetric6(stress.S) + F * from_symmetric6(change.S) + stress.wJ * dcof + change.wJ * cofactor(F);
}

}  // namespace heml
