#pragma once
// HEML in tension form (Goulette & Chendeb 2006, Eq. 2): forces of one law on one element.
//
// With edges e_a = x_a − x_0 and their Gram matrix G (squared lengths in another basis: l_0a = G_aa, l_ab = G_aa + G_bb
// − 2 G_ab), all that a law needs of C follows from G and constants of the rest shape, A = Dm⁻¹Dm⁻ᵀ and m = Dm⁻¹a0:
//     I1 = A:G,   tr C² = (AGA):G,   J = e_1·(e_2×e_3) / 6V,   I4 = m·Gm,   I5 = n·Gm with n = AGm.
// The tensions are T_ab = V g_a·S g_b = V [2 (w1 + w2 I1) A − 2 w2 AGA + 2 w4 m mᵀ + 2 w5 (m nᵀ + n mᵀ)]_ab, one
// scalar a link (a link 0a has −Σ_b T_ab), and
//     f_a = −Σ_b T_ab e_b − V wJ ∂J/∂x_a,   f_0 = −(f_1 + f_2 + f_3);
// F is never formed. A law of principal stretches needs C itself, up to a rotation: LᵀGL with A = LLᵀ (Cholesky) has
// its eigenvalues, and T = V L S Lᵀ. Departures from the paper: Table 1 drops the factor 2 of the quadratic forms and
// leaves V implicit; the volume term uses the signed J, whose gradient is a cross product of edges, since a mirror
// image has the same squared lengths.
//
// The stiffness is the derivative of these forces (in the paper's notation K = L(k) ⊗ I + Gᵀ 4V W_ll G).
#include <cmath>
#include <heml/elastic/element_group.hpp>
#include <heml/materials/law.hpp>
#include <heml/materials/principal.hpp>

namespace heml {

/// Quantities of one deformed element that forces and stiffness use.
template <class Real>
struct ElementKinematics {
  Real e[3][3];   ///< edges from node 0, m
  Real G[6];      ///< Gram matrix 11 22 33 12 13 23, m²
  Real AG[3][3];  ///< A G; with I2 only
  Real n[3];      ///< A G m, 1/m; with I5 only
  Invariants<Real> at;
  Real cross[3][3];  ///< 6V ∂J/∂x_a, a = 1..3, m²; with J only
};

/// The constants of one element's rest shape.
template <class Real>
struct RestShape {
  Real A[6];                  ///< 1/m²
  Real volume;                ///< m³
  Real fibre[3] = {0, 0, 0};  ///< m = Dm⁻¹a0, 1/m; zero: none
};

/// Tensions T_ab of the links of an element (N/m) as 11 22 33 12 13 23, and wJ (Pa); or changes of them.
template <class Real>
struct Tensions {
  Real T[6], wJ;
};

/// Cross products of edges, 6V ∂J/∂x_a.
template <class Real>
[[gnu::always_inline]] inline void cross_edges(const Real e[3][3], Real cross[3][3]) {
  for (int a = 0; a < 3; ++a) {
    const Real* p = e[(a + 1) % 3];
    const Real* q = e[(a + 2) % 3];
    cross[a][0] = p[1] * q[2] - p[2] * q[1];
    cross[a][1] = p[2] * q[0] - p[0] * q[2];
    cross[a][2] = p[0] * q[1] - p[1] * q[0];
  }
}

/// Lower Cholesky factor L of A = LLᵀ.
template <class Real>
[[gnu::always_inline]] inline void cholesky3(const Real A[6], Real L[3][3]) {
  using std::sqrt;  // other scalar types have their own
  L[0][1] = L[0][2] = L[1][2] = 0;
  L[0][0] = sqrt(A[0]);
  L[1][0] = A[3] / L[0][0];
  L[2][0] = A[4] / L[0][0];
  L[1][1] = sqrt(A[1] - L[1][0] * L[1][0]);
  L[2][1] = (A[5] - L[2][0] * L[1][0]) / L[1][1];
  L[2][2] = sqrt(A[2] - L[2][0] * L[2][0] - L[2][1] * L[2][1]);
}

/// C = LᵀGL: a symmetric matrix in the orthonormal rest frame that belongs to the Cholesky factor L of A.
template <class Real>
[[gnu::always_inline]] inline void into_rest_frame(const Real L[3][3], const Real G[6], Real C[6]) {
  const Real Lt[3][3] = {{L[0][0], L[1][0], L[2][0]}, {L[0][1], L[1][1], L[2][1]}, {L[0][2], L[1][2], L[2][2]}};
  congruence3(Lt, G, C);
}

/// Edges and Gram matrix of an element; if needed, cross products and J, else J = 1.
template <bool need_J, class Real>
[[gnu::always_inline]] inline void put_edges(const Real* x0, const Real* x1, const Real* x2, const Real* x3,
                                             Real volume, ElementKinematics<Real>& kinematics) {
  for (int i = 0; i < 3; ++i) {
    kinematics.e[0][i] = x1[i] - x0[i];
    kinematics.e[1][i] = x2[i] - x0[i];
    kinematics.e[2][i] = x3[i] - x0[i];
  }
  const auto& e = kinematics.e;
  const auto dot = [](const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  kinematics.G[0] = dot(e[0], e[0]);
  kinematics.G[1] = dot(e[1], e[1]);
  kinematics.G[2] = dot(e[2], e[2]);
  kinematics.G[3] = dot(e[0], e[1]);
  kinematics.G[4] = dot(e[0], e[2]);
  kinematics.G[5] = dot(e[1], e[2]);
  kinematics.at.J = 1;
  if constexpr (need_J) {
    cross_edges(e, kinematics.cross);
    kinematics.at.J = dot(e[0], kinematics.cross[0]) / (6 * volume);
  }
}

/// I1 from the Gram matrix; if needed, I2, I4 and I5, else I2 = 0 and the others are 1.
template <bool need_I2, bool need_I4, bool need_I5, class Real>
[[gnu::always_inline]] inline void put_invariants(const RestShape<Real>& rest, ElementKinematics<Real>& kinematics) {
  const Real *A = rest.A, *G = kinematics.G;
  kinematics.at.I1 = double_contraction3(A, G);
  kinematics.at.I2 = 0;
  kinematics.at.I4 = 1;
  kinematics.at.I5 = 1;
  if constexpr (need_I2) {
    const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
    const Real g[3][3] = {{G[0], G[3], G[4]}, {G[3], G[1], G[5]}, {G[4], G[5], G[2]}};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) kinematics.AG[r][c] = a[r][0] * g[0][c] + a[r][1] * g[1][c] + a[r][2] * g[2][c];
    const auto& m = kinematics.AG;
    const Real trace_C2 = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2] +
                          2 * (m[0][1] * m[1][0] + m[0][2] * m[2][0] + m[1][2] * m[2][1]);
    kinematics.at.I2 = (kinematics.at.I1 * kinematics.at.I1 - trace_C2) / 2;
  }
  if constexpr (need_I4) kinematics.at.I4 = bilinear3(rest.fibre, G, rest.fibre);
  if constexpr (need_I5) {
    Real Gm[3];
    times3(G, rest.fibre, Gm);
    times3(A, Gm, kinematics.n);
    kinematics.at.I5 = Gm[0] * kinematics.n[0] + Gm[1] * kinematics.n[1] + Gm[2] * kinematics.n[2];
  }
}

/// Edges, Gram matrix and invariants of an element, of which those that are not needed are as above.
template <bool need_I2, bool need_J, bool need_I4, bool need_I5, class Real>
[[gnu::always_inline]] inline ElementKinematics<Real> element_kinematics(const Real* x0, const Real* x1, const Real* x2,
                                                                         const Real* x3, const RestShape<Real>& rest) {
  ElementKinematics<Real> kinematics;
  put_edges<need_J>(x0, x1, x2, x3, rest.volume, kinematics);
  put_invariants<need_I2, need_I4, need_I5>(rest, kinematics);
  return kinematics;
}

/// element_kinematics() with I2, J and what else the law L uses.
template <class L, class Real>
[[gnu::always_inline]] inline ElementKinematics<Real> law_kinematics(const Real* x0, const Real* x1, const Real* x2,
                                                                     const Real* x3, const RestShape<Real>& rest) {
  return element_kinematics<true, true, L::uses_I4, FibreShearLaw<L>>(x0, x1, x2, x3, rest);
}

/// element_kinematics() with all invariants.
template <class Real>
[[gnu::always_inline]] inline ElementKinematics<Real> full_element_kinematics(const Real* x0, const Real* x1,
                                                                              const Real* x2, const Real* x3,
                                                                              const RestShape<Real>& rest) {
  return element_kinematics<true, true, true, true>(x0, x1, x2, x3, rest);
}

/// AGA as 11 22 33 12 13 23.
template <class Real>
[[gnu::always_inline]] inline void product_AGA(const Real A[6], const Real AG[3][3], Real out[6]) {
  out[0] = AG[0][0] * A[0] + AG[0][1] * A[3] + AG[0][2] * A[4];
  out[1] = AG[1][0] * A[3] + AG[1][1] * A[1] + AG[1][2] * A[5];
  out[2] = AG[2][0] * A[4] + AG[2][1] * A[5] + AG[2][2] * A[2];
  out[3] = AG[0][0] * A[3] + AG[0][1] * A[1] + AG[0][2] * A[5];
  out[4] = AG[0][0] * A[4] + AG[0][1] * A[5] + AG[0][2] * A[2];
  out[5] = AG[1][0] * A[4] + AG[1][1] * A[5] + AG[1][2] * A[2];
}

/// m mᵀ as 11 22 33 12 13 23.
template <class Real>
[[gnu::always_inline]] inline void outer3(const Real m[3], Real out[6]) {
  out[0] = m[0] * m[0], out[1] = m[1] * m[1], out[2] = m[2] * m[2];
  out[3] = m[0] * m[1], out[4] = m[0] * m[2], out[5] = m[1] * m[2];
}

/// m nᵀ + n mᵀ as 11 22 33 12 13 23.
template <class Real>
[[gnu::always_inline]] inline void symmetric_product3(const Real m[3], const Real n[3], Real out[6]) {
  for (int i = 0; i < 3; ++i) out[i] = 2 * m[i] * n[i];
  out[3] = m[0] * n[1] + m[1] * n[0], out[4] = m[0] * n[2] + m[2] * n[0], out[5] = m[1] * n[2] + m[2] * n[1];
}

/// Tensions and wJ of a law at an element.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Tensions<Real> tensions(const L& law, const ElementKinematics<Real>& kinematics,
                                                      const RestShape<Real>& rest) {
  Tensions<Real> t;
  if constexpr (PrincipalLaw<L, Real>) {
    Real factor[3][3], C[6];
    cholesky3(rest.A, factor);
    into_rest_frame(factor, kinematics.G, C);
    const auto stress =
        principal_stress(law, principal_state<L::is_continued>(law, C, kinematics.at.J), kinematics.at.J);
    congruence3(factor, stress.S, t.T);
    for (Real& value : t.T) value *= rest.volume;
    t.wJ = stress.wJ;
  } else {
    const FirstDerivatives<Real> s = law.first_derivatives(kinematics.at);
    const Real pull = 2 * rest.volume * (s.w1 + (L::uses_I2 ? s.w2 * kinematics.at.I1 : Real(0)));
    for (int i = 0; i < 6; ++i) t.T[i] = pull * rest.A[i];
    if constexpr (L::uses_I2) {
      Real AGA[6];
      product_AGA(rest.A, kinematics.AG, AGA);
      for (int i = 0; i < 6; ++i) t.T[i] -= 2 * rest.volume * s.w2 * AGA[i];
    }
    if constexpr (L::uses_I4) {
      Real mm[6];
      outer3(rest.fibre, mm);
      for (int i = 0; i < 6; ++i) t.T[i] += 2 * rest.volume * s.w4 * mm[i];
    }
    if constexpr (FibreShearLaw<L>) {
      Real mn[6];
      symmetric_product3(rest.fibre, kinematics.n, mn);
      for (int i = 0; i < 6; ++i) t.T[i] += 2 * rest.volume * s.w5 * mn[i];
    }
    t.wJ = s.wJ;
  }
  return t;
}

/// W of a law at an element, Pa. kinematics: of law_kinematics().
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Real law_energy(const L& law, const ElementKinematics<Real>& kinematics,
                                              const RestShape<Real>& rest) {
  if constexpr (PrincipalLaw<L, Real>) {
    Real factor[3][3], C[6];
    cholesky3(rest.A, factor);
    into_rest_frame(factor, kinematics.G, C);
    return principal_energy<L::is_continued>(law, C, kinematics.at.J);
  } else {
    return law.energy(kinematics.at);
  }
}

/// Change of G and J with a change de of the edges.
template <class Real>
struct KinematicsDifferential {
  Real G[6], J;
};
template <class Real>
[[gnu::always_inline]] inline KinematicsDifferential<Real> kinematics_differential(
    const ElementKinematics<Real>& kinematics, const Real de[3][3], Real volume) {
  const auto dot = [](const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto& e = kinematics.e;
  return {{2 * dot(e[0], de[0]), 2 * dot(e[1], de[1]), 2 * dot(e[2], de[2]), dot(e[0], de[1]) + dot(e[1], de[0]),
           dot(e[0], de[2]) + dot(e[2], de[0]), dot(e[1], de[2]) + dot(e[2], de[1])},
          (dot(kinematics.cross[0], de[0]) + dot(kinematics.cross[1], de[1]) + dot(kinematics.cross[2], de[2])) /
              (6 * volume)};
}

/// Tangent of a law of principal stretches at one element: computes once what all tension differentials share.
template <class Real, class L>
class PrincipalTangent {
 public:
  [[gnu::always_inline]] PrincipalTangent(const L& law, const ElementKinematics<Real>& kinematics,
                                          const RestShape<Real>& rest)
      : law_(law), J_(kinematics.at.J), volume_(rest.volume) {
    Real C[6];
    cholesky3(rest.A, factor_);
    into_rest_frame(factor_, kinematics.G, C);
    state_ = principal_state<L::is_continued>(law, C, J_);
    divided_differences(law, state_, divided_);
  }

  [[gnu::always_inline]] Tensions<Real> operator()(const KinematicsDifferential<Real>& d) const {
    Real dC[6];
    into_rest_frame(factor_, d.G, dC);
    const auto change = principal_stress_differential(law_, state_, divided_, dC, J_, d.J);
    Tensions<Real> t;
    congruence3(factor_, change.S, t.T);
    for (Real& value : t.T) value *= volume_;
    t.wJ = change.wJ;
    return t;
  }

 private:
  const L& law_;
  Real J_, volume_;
  Real factor_[3][3], divided_[6];
  PrincipalState<Real> state_;
};

/// Change of the tensions and of wJ with d. kinematics: of law_kinematics().
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Tensions<Real> tension_differential(const L& law,
                                                                  const ElementKinematics<Real>& kinematics,
                                                                  const RestShape<Real>& rest,
                                                                  const KinematicsDifferential<Real>& d) {
  Tensions<Real> t;
  if constexpr (PrincipalLaw<L, Real>) {
    t = PrincipalTangent<Real, L>(law, kinematics, rest)(d);
  } else {
    const FirstDerivatives<Real> s = law.first_derivatives(kinematics.at);
    const SecondDerivatives<Real> c = law.second_derivatives(kinematics.at);
    Real AGA[6], dAGA[6];
    const Real* A = rest.A;
    const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
    product_AGA(A, kinematics.AG, AGA);
    const Real dI1 = double_contraction3(A, d.G), dI2 = kinematics.at.I1 * dI1 - double_contraction3(AGA, d.G);
    const Real dI4 = L::uses_I4 ? bilinear3(rest.fibre, d.G, rest.fibre) : Real(0);
    Real dw1 = c.w11 * dI1 + c.w12 * dI2 + c.w1J * d.J + c.w14 * dI4;
    Real dw2 = c.w12 * dI1 + c.w22 * dI2 + c.w2J * d.J + c.w24 * dI4;
    [[maybe_unused]] Real dGm[3], dI5 = 0;
    if constexpr (FibreShearLaw<L>) {
      times3(d.G, rest.fibre, dGm);
      dI5 = 2 * (kinematics.n[0] * dGm[0] + kinematics.n[1] * dGm[1] + kinematics.n[2] * dGm[2]);
      dw1 += c.w15 * dI5;
      dw2 += c.w25 * dI5;
    }
    const Real pull = dw1 + dw2 * kinematics.at.I1 + s.w2 * dI1;
    for (int i = 0; i < 6; ++i) t.T[i] = 2 * rest.volume * pull * A[i];
    if constexpr (L::uses_I2) {
      congruence3(a, d.G, dAGA);
      for (int i = 0; i < 6; ++i) t.T[i] -= 2 * rest.volume * (dw2 * AGA[i] + s.w2 * dAGA[i]);
    }
    t.wJ = c.w1J * dI1 + c.w2J * dI2 + c.wJJ * d.J;
    if constexpr (L::uses_I4) {
      Real mm[6];
      outer3(rest.fibre, mm);
      Real dw4 = c.w14 * dI1 + c.w24 * dI2 + c.w4J * d.J + c.w44 * dI4;
      if constexpr (FibreShearLaw<L>) dw4 += c.w45 * dI5;
      for (int i = 0; i < 6; ++i) t.T[i] += 2 * rest.volume * dw4 * mm[i];
      t.wJ += c.w4J * dI4;
    }
    if constexpr (FibreShearLaw<L>) {
      Real dn[3], mn[6], mdn[6];
      times3(A, dGm, dn);
      symmetric_product3(rest.fibre, kinematics.n, mn);
      symmetric_product3(rest.fibre, dn, mdn);
      const Real dw5 = c.w15 * dI1 + c.w25 * dI2 + c.w5J * d.J + c.w45 * dI4 + c.w55 * dI5;
      for (int i = 0; i < 6; ++i) t.T[i] += 2 * rest.volume * (dw5 * mn[i] + s.w5 * mdn[i]);
      t.wJ += c.w5J * dI5;
    }
  }
  return t;
}

/// Corner forces −Σ_b T_ab e_b − (wJ/6) cross_a into out[12] ([corner][xyz], N).
template <bool with_J, class Real>
[[gnu::always_inline]] inline void forces_from_tensions(const Tensions<Real>& t, const Real e[3][3],
                                                        const Real cross[3][3], Real out[12]) {
  const Real T[3][3] = {{t.T[0], t.T[3], t.T[4]}, {t.T[3], t.T[1], t.T[5]}, {t.T[4], t.T[5], t.T[2]}};
  for (int i = 0; i < 3; ++i) {
    Real sum = 0;
    for (int a = 0; a < 3; ++a) {
      Real f = T[a][0] * e[0][i] + T[a][1] * e[1][i] + T[a][2] * e[2][i];
      if constexpr (with_J) f += t.wJ / 6 * cross[a][i];
      out[3 * (a + 1) + i] = -f;
      sum += f;
    }
    out[i] = sum;
  }
}

/// Corner forces of one element. Returns whether the law is defined there.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline Mask<Real> corner_forces(const L& law, const Real* x0, const Real* x1, const Real* x2,
                                                       const Real* x3, const RestShape<Real>& rest, Real out[12]) {
  const ElementKinematics<Real> kinematics =
      element_kinematics<L::uses_I2, L::uses_J, L::uses_I4, FibreShearLaw<L>>(x0, x1, x2, x3, rest);
  forces_from_tensions<L::uses_J>(tensions(law, kinematics, rest), kinematics.e, kinematics.cross, out);
  return law.valid(kinematics.at);
}

/// Change of the corner forces with a change de of the edges, given the tensions and their change: −K dx.
template <class Real>
[[gnu::always_inline]] inline void corner_force_differential(const Tensions<Real>& t, const Tensions<Real>& dt,
                                                             const ElementKinematics<Real>& kinematics,
                                                             const Real de[3][3], Real out[12]) {
  Real dcross[3][3];
  for (int a = 0; a < 3; ++a) {
    const Real *p = kinematics.e[(a + 1) % 3], *q = kinematics.e[(a + 2) % 3];
    const Real *dp = de[(a + 1) % 3], *dq = de[(a + 2) % 3];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      dcross[a][i] = dp[j] * q[k] - dp[k] * q[j] + p[j] * dq[k] - p[k] * dq[j];
    }
  }
  Real other[12];
  forces_from_tensions<true>(t, de, dcross, out);
  forces_from_tensions<true>(dt, kinematics.e, kinematics.cross, other);
  for (int i = 0; i < 12; ++i) out[i] += other[i];
}

}  // namespace heml
