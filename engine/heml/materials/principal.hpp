#pragma once
// Stress and stress differential of laws of principal stretches, W = Σ_i h(c̄_i) + ψ(J), where c̄_i and n_i are the
// eigenvalues and eigenvectors of C̄ = p C, p = J^(−2/3):
//   S  = 2 p H,  H = Σ_i h1(c̄_i) n_i n_iᵀ            (S = 2 ∂W/∂C at fixed J)
//   wJ = p' H:C + ψ'(J)
//   dH = Σ_ij h1[c̄_i, c̄_j] (n_i·dC̄ n_j) n_i n_jᵀ     (divided differences; Daleckii & Krein 1965)
#include <heml/materials/volume.hpp>
#include <heml/math/symmetric3.hpp>

namespace heml {

/// S = 2 ∂W/∂C at fixed J (11 22 33 12 13 23) and wJ = ∂W/∂J at fixed C, Pa.
template <class Real>
struct Stress {
  Real S[6], wJ;
};

template <class Real>
struct PrincipalState {
  SymmetricEigen3<Real> e;  ///< of C
  VolumePowers<Real> v;
  Real h1[3];
};

template <bool continued, class Real, PrincipalLaw<Real> L>
[[gnu::always_inline]] inline PrincipalState<Real> principal_state(const L& law, const Real C[6], Real J) {
  PrincipalState<Real> state{symmetric_eigen3(C), volume_powers<continued>(J), {}};
  for (int i = 0; i < 3; ++i) state.h1[i] = law.principal(state.v.p * state.e.value[i]).h1;
  return state;
}

template <class Real, PrincipalLaw<Real> L>
[[gnu::always_inline]] inline Stress<Real> principal_stress(const L& law, const PrincipalState<Real>& at, Real J) {
  Stress<Real> stress;
  spectral_sum3(at.e, at.h1, stress.S);
  for (Real& s : stress.S) s *= 2 * at.v.p;
  Real HC = 0;
  for (int i = 0; i < 3; ++i) HC += at.h1[i] * at.e.value[i];
  stress.wJ = at.v.p1 * HC + law.volume(J).w1;
  return stress;
}

/// h1[c̄_i, c̄_j] for 11 22 33 12 13 23. Independent of dC and dJ: computed once per state.
template <class Real, PrincipalLaw<Real> L>
[[gnu::always_inline]] inline void divided_differences(const L& law, const PrincipalState<Real>& at, Real divided[6]) {
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k)
    divided[k] = law.divided_difference(at.v.p * at.e.value[row[k]], at.v.p * at.e.value[col[k]]);
}

/// Change of S and wJ for changes dC (11 22 33 12 13 23) and dJ, Pa.
template <class Real, PrincipalLaw<Real> L>
[[gnu::always_inline]] inline Stress<Real> principal_stress_differential(const L& law, const PrincipalState<Real>& at,
                                                                         const Real divided[6], const Real dC[6],
                                                                         Real J, Real dJ) {
  const auto& [p, p1, p2, q, q1, q2] = at.v;
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
  // dC̄, then dH, in the frame of the eigenvectors.
  Real dH[6], HdC = 0, HC = 0, dHC = 0;
  for (int k = 0; k < 6; ++k) {
    const int i = row[k], j = col[k];
    const Real c = bilinear3(at.e.vector[i], dC, at.e.vector[j]);
    Real m = p * c;
    if (i == j) {
      m += p1 * dJ * at.e.value[i];
      HdC += at.h1[i] * c;
      HC += at.h1[i] * at.e.value[i];
    }
    dH[k] = divided[k] * m;
    if (i == j) dHC += dH[k] * at.e.value[i];
  }
  const Real N[3][3] = {{at.e.vector[0][0], at.e.vector[1][0], at.e.vector[2][0]},
                        {at.e.vector[0][1], at.e.vector[1][1], at.e.vector[2][1]},
                        {at.e.vector[0][2], at.e.vector[1][2], at.e.vector[2][2]}};
  Stress<Real> change;
  Real H[6];
  congruence3(N, dH, change.S);
  spectral_sum3(at.e, at.h1, H);
  for (int k = 0; k < 6; ++k) change.S[k] = 2 * (p * change.S[k] + p1 * dJ * H[k]);
  change.wJ = p2 * dJ * HC + p1 * (dHC + HdC) + law.volume(J).w2 * dJ;
  return change;
}

template <bool continued, class Real, PrincipalLaw<Real> L>
Real principal_energy(const L& law, const Real C[6], Real J) {
  const auto e = symmetric_eigen3(C);
  const Real p = volume_powers<continued>(J).p;
  Real W = law.volume(J).w;
  for (int i = 0; i < 3; ++i) W += law.principal(p * e.value[i]).h;
  return W;
}

}  // namespace heml
