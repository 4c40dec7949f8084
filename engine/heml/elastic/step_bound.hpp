#pragma once
// The stable step of explicit methods, from an upper bound of the stiffness of each element. No iteration; valid in
// motion, since the bound is evaluated at the deformed state.
//
// An element's bound b holds for K_t ≤ b M_t with M_t = ρV/4 z_a on corner a, also if K_t is indefinite; what follows
// from those of all is in node_bounds.hpp. z_a > 0 are numbers of the nodes (step_weights.hpp), w_a = 1/z_a, and |u|²
// here is Σ z_a |u_a|². K_t/V is the quadratic form of ∂²W/∂F² in dF = Σ_a u_a ⊗ g_a, the sum of two parts. The second
// derivatives H of W by the invariants give Σ H_αβ dI_α dI_β ≤ λ_max(H N) |u|², N_αβ = Σ_a w_a ∂I_α/∂x_a·∂I_β/∂x_a,
// exact for the pair I1, J. The second derivatives of the invariants themselves are bounded term by term:
//   |dF|² ≤ γ|u|²,   γ = λ_max(Σ w_a g_a g_aᵀ);      |dC|² ≤ 4 σ1² |dF|²;      d²I4 = 2 |dF a0|² ≤ 2 Σ w_a m_a² |u|²
//   d²I5 = 2 |dC a0|² + 4 (dF a0)·(dF C a0),   |dC a0| ≤ (√(I4 γ) + σ1 √(Σ w_a m_a²)) |u|
//   d²I2 = (dI1)² + 2 I1 |dF|² − |dC|² − 2 C:dFᵀdF, whose first term is counted with H
//   −√2 σ1 |dF|² ≤ d²J ≤ 2 σ1 |dF|², and for J > 0: d²J = ((dJ)² − tr((F⁻¹dF J)²))/J, which is sharper near rest.
// σ1 ≥ σ2 ≥ σ3: principal stretches, bounded by mean and spread of the eigenvalues of C (Wolkowicz & Styan 1980).
#include <algorithm>
#include <cmath>
#include <heml/elastic/edge_stiffness.hpp>
#include <limits>

namespace heml {

/// w_a of an element's corners.
template <class Real>
struct CornerWeights {
  Real w[4] = {1, 1, 1, 1};
};

/// Σ_a w_a S_aa of a symmetric matrix over the corners, of which rows sum to zero; S: that of corners 1 to 3.
template <class Real>
[[gnu::always_inline]] inline Real over_corners(const Real S[6], const CornerWeights<Real>& weights) {
  const Real* w = weights.w;
  return w[1] * S[0] + w[2] * S[1] + w[3] * S[2] + w[0] * (S[0] + S[1] + S[2] + 2 * (S[3] + S[4] + S[5]));
}

/// γ = λ_max(Σ_a w_a g_a g_aᵀ), 1/m², or up to 2 % more: that of T = A (diag(w_1, w_2, w_3) + w_0 1 1ᵀ). With θ = acos
/// r of Cardano's r, cos(θ/3) is concave in cos(θ/2), so below the tangents at its ends.
template <class Real>
[[gnu::always_inline]] inline Real max_gradient(const Real A[6], const CornerWeights<Real>& weights) {
  const Real* w = weights.w;
  const Real s0 = w[0] * (A[0] + A[3] + A[4]), s1 = w[0] * (A[3] + A[1] + A[5]), s2 = w[0] * (A[4] + A[5] + A[2]);
  const Real mean = (w[1] * A[0] + w[2] * A[1] + w[3] * A[2] + s0 + s1 + s2) / 3;
  const Real a = w[1] * A[0] + s0 - mean, e = w[2] * A[1] + s1 - mean, i = w[3] * A[2] + s2 - mean;
  const Real b = w[2] * A[3] + s0, c = w[3] * A[4] + s0, d = w[1] * A[3] + s1;
  const Real f = w[3] * A[5] + s1, g = w[1] * A[4] + s2, h = w[2] * A[5] + s2;
  const Real square = (a * a + e * e + i * i + 2 * (b * d + c * g + f * h)) / 6;
  const Real p = std::sqrt(std::max(square, Real(0)));
  // p³ of a tiny element is no float; of a regular one p is round-off, also 0 beside a, e, i that are not.
  const Real noise = std::max(std::numeric_limits<Real>::epsilon() * mean, std::numeric_limits<Real>::min());
  const Real unit = 1 / std::max(p, noise);
  const Real det = (a * unit) * ((e * unit) * (i * unit) - (f * unit) * (h * unit)) -
                   (b * unit) * ((d * unit) * (i * unit) - (f * unit) * (g * unit)) +
                   (c * unit) * ((d * unit) * (h * unit) - (e * unit) * (g * unit));
  const Real t = std::sqrt(std::min(std::max((2 + det) / 4, Real(0)), Real(1)));
  const Real cosine = std::min(Real(0.5) + Real(0.57736) * t, 1 + Real(4.0 / 9) * (t - 1));
  return (mean + 2 * p * cosine) * (1 + 16 * std::numeric_limits<Real>::epsilon());
}

/// Sums over an element's four corners that the bounds use, weighted.
template <class Real>
struct CornerSums {
  Real n1;  ///< (dI1)² ≤ n1 |u|²
  Real nJ;  ///< (dJ)² ≤ nJ |u|²
  Real m;   ///< Σ w_a m_a²
};

template <class Real>
[[gnu::always_inline]] inline CornerSums<Real> corner_sums(const ElementKinematics<Real>& kinematics,
                                                           const RestShape<Real>& rest,
                                                           const CornerWeights<Real>& weights) {
  const Real* w = weights.w;
  Real AGA[6];  // F g_a·F g_b
  product_AGA(rest.A, kinematics.AG, AGA);
  CornerSums<Real> sums{4 * over_corners(AGA, weights), 0, 0};
  const Real of_cross = 1 / (6 * rest.volume);  // first, since V² of an element of a micrometre is no float
  for (int i = 0; i < 3; ++i) {
    Real sum = 0;
    for (int a = 0; a < 3; ++a) {
      const Real dJ = of_cross * kinematics.cross[a][i];
      sums.nJ += w[a + 1] * dJ * dJ;
      sum += dJ;
    }
    sums.nJ += w[0] * sum * sum;
  }
  const Real total = rest.fibre[0] + rest.fibre[1] + rest.fibre[2];
  for (int a = 0; a < 3; ++a) sums.m += w[a + 1] * rest.fibre[a] * rest.fibre[a];
  sums.m += w[0] * total * total;
  return sums;
}

/// Upper bounds of the largest and the middle eigenvalue of C.
template <class Real>
struct StretchBounds {
  Real max, middle;
};
template <class Real>
[[gnu::always_inline]] inline StretchBounds<Real> stretch_bounds(const Invariants<Real>& at) {
  const Real mean = at.I1 / 3;
  const Real spread = std::sqrt(std::max((at.I1 * at.I1 - 2 * at.I2) / 3 - mean * mean, Real(0)));
  return {mean + Real(1.4142136) * spread, mean + Real(0.70710678) * spread};
}

/// Symmetric matrix over the invariants that a law uses; I1 always is one. Plain numbers, so that loops vectorise.
template <class Real>
struct InvariantMatrix {
  Real n11 = 0, n12 = 0, n22 = 0, n1J = 0, n2J = 0, nJJ = 0, n14 = 0, n4J = 0, n44 = 0;
};

/// Products N_αβ = Σ_a w_a ∂I_α/∂x_a·∂I_β/∂x_a over an element's corners.
template <class L, class Real>
[[gnu::always_inline]] inline InvariantMatrix<Real> gradient_products(const ElementKinematics<Real>& kinematics,
                                                                      const RestShape<Real>& rest,
                                                                      const CornerSums<Real>& sums,
                                                                      const CornerWeights<Real>& weights) {
  const Real *A = rest.A, *w = weights.w;
  const auto& [I1, I2, J, I4, I5] = kinematics.at;
  const Real q0 = over_corners(A, weights), q1 = sums.n1 / 4;  // Σ_a w_a g_a·Cᵏ g_a
  InvariantMatrix<Real> N;
  N.n11 = sums.n1;
  N.n1J = 2 * J * q0;
  N.nJJ = sums.nJ;
  if constexpr (L::uses_I2) {
    Real AGA[6];
    product_AGA(A, kinematics.AG, AGA);
    const auto& m = kinematics.AG;
    const Real B[3][3] = {{AGA[0], AGA[3], AGA[4]}, {AGA[3], AGA[1], AGA[5]}, {AGA[4], AGA[5], AGA[2]}};
    const auto entry = [&](int r, int c) { return m[r][0] * B[0][c] + m[r][1] * B[1][c] + m[r][2] * B[2][c]; };
    const Real AGAGA[6] = {entry(0, 0), entry(1, 1), entry(2, 2), entry(0, 1), entry(0, 2), entry(1, 2)};
    const Real q2 = over_corners(AGAGA, weights), q3 = I1 * q2 - I2 * q1 + J * J * q0;  // Cayley–Hamilton
    N.n12 = 4 * (I1 * q1 - q2);
    N.n22 = 4 * (I1 * I1 * q1 - 2 * I1 * q2 + q3);
    N.n2J = 2 * J * (I1 * q0 - q1);
  }
  if constexpr (L::uses_I4) {
    const Real *m = rest.fibre, *G = kinematics.G;
    const Real Gm[3] = {G[0] * m[0] + G[3] * m[1] + G[4] * m[2], G[3] * m[0] + G[1] * m[1] + G[5] * m[2],
                        G[4] * m[0] + G[5] * m[1] + G[2] * m[2]};
    const Real AGm[3] = {A[0] * Gm[0] + A[3] * Gm[1] + A[4] * Gm[2], A[3] * Gm[0] + A[1] * Gm[1] + A[5] * Gm[2],
                         A[4] * Gm[0] + A[5] * Gm[1] + A[2] * Gm[2]};
    // Σ_a w_a m_a g_a·C a0; corner 0 has minus the sums.
    N.n14 = 4 * (w[1] * m[0] * AGm[0] + w[2] * m[1] * AGm[1] + w[3] * m[2] * AGm[2] +
                 w[0] * (m[0] + m[1] + m[2]) * (AGm[0] + AGm[1] + AGm[2]));
    N.n4J = 2 * J * sums.m;
    N.n44 = 4 * I4 * sums.m;
  }
  return N;
}

/// An upper bound of the largest eigenvalue of H N (real, since N is positive semidefinite) from its traces (Wolkowicz
/// & Styan 1980); exact for rank 2. H and N: upper triangles 11 12 13 22 23 33; an unused third row is zero.
template <int rank, class Real>
[[gnu::always_inline]] inline Real max_eigenvalue(const Real H[6], const Real N[6]) {
  const Real p00 = H[0] * N[0] + H[1] * N[1] + H[2] * N[2], p01 = H[0] * N[1] + H[1] * N[3] + H[2] * N[4];
  const Real p02 = H[0] * N[2] + H[1] * N[4] + H[2] * N[5], p10 = H[1] * N[0] + H[3] * N[1] + H[4] * N[2];
  const Real p11 = H[1] * N[1] + H[3] * N[3] + H[4] * N[4], p12 = H[1] * N[2] + H[3] * N[4] + H[4] * N[5];
  const Real p20 = H[2] * N[0] + H[4] * N[1] + H[5] * N[2], p21 = H[2] * N[1] + H[4] * N[3] + H[5] * N[4];
  const Real p22 = H[2] * N[2] + H[4] * N[4] + H[5] * N[5];
  const Real trace = p00 + p11 + p22;
  const Real square = p00 * p00 + p11 * p11 + p22 * p22 + 2 * (p01 * p10 + p02 * p20 + p12 * p21);
  const Real mean = trace / rank, spread = std::max(square / rank - mean * mean, Real(0));
  return std::max(mean + std::sqrt((rank - 1) * spread), Real(0));
}
template <class Real>
[[gnu::always_inline]] inline Real max_eigenvalue2(Real H11, Real H12, Real H22, Real N11, Real N12, Real N22) {
  const Real trace = H11 * N11 + 2 * H12 * N12 + H22 * N22;
  const Real det = (H11 * H22 - H12 * H12) * (N11 * N22 - N12 * N12);
  return std::max((trace + std::sqrt(std::max(trace * trace - 4 * det, Real(0)))) / 2, Real(0));
}

/// Upper bound of the largest eigenvalue of H N over the invariants a law uses: I1 and at most two of I2, J, I4.
template <class L, class Real>
[[gnu::always_inline]] inline Real max_curvature(const InvariantMatrix<Real>& H, const InvariantMatrix<Real>& N) {
  static_assert(!(L::uses_I2 && L::uses_I4));
  if constexpr (L::uses_I2 && L::uses_J) {
    const Real h[6] = {H.n11, H.n12, H.n1J, H.n22, H.n2J, H.nJJ}, n[6] = {N.n11, N.n12, N.n1J, N.n22, N.n2J, N.nJJ};
    return max_eigenvalue<3>(h, n);
  } else if constexpr (L::uses_I4) {
    const Real h[6] = {H.n11, H.n14, H.n1J, H.n44, H.n4J, H.nJJ}, n[6] = {N.n11, N.n14, N.n1J, N.n44, N.n4J, N.nJJ};
    return max_eigenvalue<3>(h, n);
  } else if constexpr (L::uses_I2) {
    return max_eigenvalue2(H.n11, H.n12, H.n22, N.n11, N.n12, N.n22);
  } else {
    return max_eigenvalue2(H.n11, H.n1J, H.nJJ, N.n11, N.n1J, N.nJJ);
  }
}

/// As max_curvature(), for a law with I5: over I1, J, I2, I4 and I5. c: the derivatives by I4 and I5.
template <class Real>
[[gnu::always_inline]] inline Real max_fibre_curvature(const Real (&N)[5][5], const InvariantMatrix<Real>& H,
                                                       const SecondDerivatives<Real>& c) {
  const Real h[5][5] = {{H.n11, H.n1J, H.n12, c.w14, c.w15},
                        {H.n1J, H.nJJ, H.n2J, c.w4J, c.w5J},
                        {H.n12, H.n2J, H.n22, c.w24, c.w25},
                        {c.w14, c.w4J, c.w24, c.w44, c.w45},
                        {c.w15, c.w5J, c.w25, c.w45, c.w55}};
  Real p[5][5], trace = 0, square = 0;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) {
      p[i][j] = 0;
      for (int k = 0; k < 5; ++k) p[i][j] += h[i][k] * N[k][j];
    }
  for (int i = 0; i < 5; ++i) {
    trace += p[i][i];
    for (int j = 0; j < 5; ++j) square += p[i][j] * p[j][i];
  }
  const Real mean = trace / 5, spread = std::max(square / 5 - mean * mean, Real(0));
  return std::max(mean + std::sqrt(4 * spread), Real(0));
}

/// N_αβ over I1, J, I2, I4, I5 at the four corners.
template <class L, class Real>
[[gnu::always_inline]] inline void all_gradient_products(const ElementKinematics<Real>& kinematics,
                                                         const RestShape<Real>& rest,
                                                         const CornerWeights<Real>& weights, Real (&N)[5][5]) {
  const Real* w = weights.w;
  Real u[3][3], p[5][9];
  invariant_gradients<L>(kinematics, rest, u, p);
  for (int k = 0; k < 5; ++k)
    for (int l = 0; l < 5; ++l) {
      N[k][l] = 0;
      for (int i = 0; i < 3; ++i) {
        const Real *a = p[k] + i, *b = p[l] + i;
        N[k][l] += w[1] * a[0] * b[0] + w[2] * a[3] * b[3] + w[3] * a[6] * b[6] +
                   w[0] * (a[0] + a[3] + a[6]) * (b[0] + b[3] + b[6]);
      }
    }
}

/// Bounds of S:(dFᵀdF) with S = 2 w4 a0 a0ᵀ + 2 w5 (a0 (C a0)ᵀ + C a0 a0ᵀ), and of 2 w5 |dC a0|².
template <class Real>
[[gnu::always_inline]] inline Real fibre_bound(const FirstDerivatives<Real>& s,
                                               const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                                               const CornerSums<Real>& sums, const CornerWeights<Real>& weights,
                                               Real largest, Real gamma) {
  const Real* w = weights.w;
  // The first is rank two in the corners: m qᵀ + q mᵀ with q = w4 m + 2 w5 n, whose larger eigenvalue is m·q + |m||q|.
  const Real *m = rest.fibre, *n = kinematics.n;
  Real q[3], mq = 0, qq = 0, total = 0;
  for (int a = 0; a < 3; ++a) {
    q[a] = s.w4 * m[a] + 2 * s.w5 * n[a];
    mq += w[a + 1] * m[a] * q[a], qq += w[a + 1] * q[a] * q[a], total += q[a];
  }
  mq += w[0] * (m[0] + m[1] + m[2]) * total, qq += w[0] * total * total;
  const Real side = std::sqrt(std::max(kinematics.at.I4, Real(0)) * gamma) + std::sqrt(largest * sums.m);  // |dC a0|
  return mq + std::sqrt(sums.m * qq) + 2 * std::max(s.w5, Real(0)) * side * side;
}

/// Upper bound of λ_max(M_t⁻¹K_t), 1/s², of one element. kinematics: of law_kinematics(). density: kg/m³.
template <class Real, InvariantLaw<Real> L>
[[gnu::always_inline]] inline Real element_frequency_bound(const L& law, const ElementKinematics<Real>& kinematics,
                                                           const RestShape<Real>& rest,
                                                           const CornerWeights<Real>& weights, Real density) {
  const FirstDerivatives<Real> s = law.first_derivatives(kinematics.at);
  const SecondDerivatives<Real> c = law.second_derivatives(kinematics.at);
  const Real I1 = kinematics.at.I1, J = kinematics.at.J;
  const auto positive = [](Real value) { return std::max(value, Real(0)); };
  const auto [largest, middle] = stretch_bounds(kinematics.at);
  const Real sigma1 = std::sqrt(largest), gamma = max_gradient(rest.A, weights);
  const CornerSums<Real> sums = corner_sums(kinematics, rest, weights);

  // S:(dFᵀdF) with S = 2 (w1 + I1 w2) I − 2 w2 C + 2 w4 a0 a0ᵀ, and −w2 |dC|².
  Real bound = positive(2 * (s.w1 + I1 * s.w2) + 2 * positive(-s.w2) * largest) * gamma;
  bound += positive(-s.w2) * 4 * largest * gamma;
  if constexpr (FibreShearLaw<L>)
    bound += fibre_bound(s, kinematics, rest, sums, weights, largest, gamma);
  else if constexpr (L::uses_I4)
    bound += 2 * positive(s.w4) * sums.m;

  InvariantMatrix<Real> H{c.w11 + s.w2, c.w12, c.w22, c.w1J, c.w2J, c.wJJ, c.w14, c.w4J, c.w44};
  const auto curvature = [&] {
    if constexpr (FibreShearLaw<L>) {
      Real N[5][5];
      all_gradient_products<L>(kinematics, rest, weights, N);
      return max_fibre_curvature(N, H, c);
    } else {
      return max_curvature<L>(H, gradient_products<L>(kinematics, rest, sums, weights));
    }
  };
  const Real plain = curvature() + (s.wJ > 0 ? 2 * s.wJ : Real(-1.4142136) * s.wJ) * sigma1 * gamma;
  H.nJJ += s.wJ / J;
  const Real sharper = curvature() + std::abs(s.wJ) * (largest * middle / J) * gamma;
  const Real curved = J > 0 && sharper < plain ? sharper : plain;  // a select, no branch: the loop vectorises
  return 4 / density * (bound + curved);
}

/// The same for a law of principal stretches: d²W = dH:dC̄ + H:d²C̄ + ψ'' (dJ)² + ψ' d²J term by term, with d²C̄ = 2p
/// dFᵀdF + 2p' dJ dC + (p'' (dJ)² + p' d²J) C. In the frame of the eigenvectors, with X = dF there, |dC_ij|² ≤ (σi² +
/// σj²)(X_ij² + X_ji²), so a strongly compressed direction counts with its own small σ only.
template <class Real, PrincipalLaw<Real> L>
Real element_frequency_bound(const L& law, const ElementKinematics<Real>& kinematics, const RestShape<Real>& rest,
                             const CornerWeights<Real>& weights, Real density) {
  Real factor[3][3], C[6];
  cholesky3(rest.A, factor);
  into_rest_frame(factor, kinematics.G, C);
  const auto at = principal_state<L::is_continued>(law, C, kinematics.at.J);
  const Real* c = at.e.value;
  const auto [n1, nJ, m] = corner_sums(kinematics, rest, weights);
  const Real gamma = max_gradient(rest.A, weights);
  const Real sigma1 = std::sqrt(std::max({c[0], c[1], c[2]})), p = at.v.p, p1 = std::abs(at.v.p1);
  Real most = 0, square = 0, HC = 0, shape = 0, volume = 0;
  for (int i = 0; i < 3; ++i) {
    most = std::max(most, at.h1[i]);
    square += at.h1[i] * at.h1[i];
    HC += at.h1[i] * c[i];
    for (int j = i; j < 3; ++j) {
      const Real slope = std::max(law.divided_difference(p * c[i], p * c[j]), Real(0));
      shape = std::max(shape, 2 * slope * (c[i] + c[j]));
      if (i == j) volume += slope * c[i] * c[i];
    }
  }
  const Real change = p * std::sqrt(shape * gamma) + p1 * std::sqrt(volume * nJ);
  Real bound = change * change + 2 * p * most * gamma;
  bound += 4 * p1 * sigma1 * std::sqrt(square * nJ * gamma) + std::max(at.v.p2 * HC, Real(0)) * nJ;
  bound += 2 * std::abs(at.v.p1 * HC) * sigma1 * gamma;
  const auto volume_value = law.volume(kinematics.at.J);
  bound += volume_value.w2 * nJ + 2 * std::abs(volume_value.w1) * sigma1 * gamma;
  return 4 / density * bound;
}

}  // namespace heml
