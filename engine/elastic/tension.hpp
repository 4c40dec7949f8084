#pragma once
// HEML in tension form (Goulette & Chendeb 2006, Eq. 2): forces of one law on a group of elements.
//
// With edges e_a = x_a − x_0 and their Gram matrix G (squared lengths in another basis: l_0a = G_aa, l_ab = G_aa + G_bb
// − 2 G_ab), everything an isotropic law needs of C is in G and the constant A = Dm⁻¹Dm⁻ᵀ:
//     I1 = A:G,   tr C² = (AGA):G,   J = e_1·(e_2×e_3) / 6V.
// The tensions are T_ab = V g_a·S g_b = V [2 (w1 + w2 I1) A − 2 w2 AGA]_ab, one scalar a link (a link 0a has −Σ_b
// T_ab), and
//     f_a = −Σ_b T_ab e_b − V wJ ∂J/∂x_a,   f_0 = −(f_1 + f_2 + f_3);
// F is never formed. Departures from the paper: Table 1 drops the factor 2 of the quadratic forms and leaves V
// implicit; the volume term uses the signed J, whose gradient is a cross product of edges, since squared lengths do not
// see a mirror image.
#include <cmath>
#include <heml/elastic/element_group.hpp>
#include <heml/materials/law.hpp>

namespace heml {

/// What the force loop and its kin read of one element.
template <class Real>
struct Link {
  Real e[3][3];   ///< edges from node 0, m
  Real G[6];      ///< Gram matrix 11 22 33 12 13 23, m²
  Real AG[3][3];  ///< A G
  Invariants<Real> at;
  Real cross[3][3];  ///< 6V ∂J/∂x_a, a = 1..3, m²
};

/// Reads an element's nodes and makes its invariants. I2 and J only where the law asks for them.
template <bool need_I2, bool need_J, class Real>
[[gnu::always_inline]] inline Link<Real> read_link(const Real* x0, const Real* x1, const Real* x2, const Real* x3,
                                                   const Real A[6], Real volume) {
  Link<Real> link;
  for (int i = 0; i < 3; ++i) {
    link.e[0][i] = x1[i] - x0[i];
    link.e[1][i] = x2[i] - x0[i];
    link.e[2][i] = x3[i] - x0[i];
  }
  const auto& e = link.e;
  const auto dot = [](const Real* a, const Real* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  link.G[0] = dot(e[0], e[0]);
  link.G[1] = dot(e[1], e[1]);
  link.G[2] = dot(e[2], e[2]);
  link.G[3] = dot(e[0], e[1]);
  link.G[4] = dot(e[0], e[2]);
  link.G[5] = dot(e[1], e[2]);
  const Real* G = link.G;
  link.at.I1 = A[0] * G[0] + A[1] * G[1] + A[2] * G[2] + 2 * (A[3] * G[3] + A[4] * G[4] + A[5] * G[5]);
  link.at.I2 = 0;
  link.at.J = 1;
  if constexpr (need_I2) {
    const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
    const Real g[3][3] = {{G[0], G[3], G[4]}, {G[3], G[1], G[5]}, {G[4], G[5], G[2]}};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) link.AG[r][c] = a[r][0] * g[0][c] + a[r][1] * g[1][c] + a[r][2] * g[2][c];
    const auto& m = link.AG;
    const Real trace_C2 = m[0][0] * m[0][0] + m[1][1] * m[1][1] + m[2][2] * m[2][2] +
                          2 * (m[0][1] * m[1][0] + m[0][2] * m[2][0] + m[1][2] * m[2][1]);
    link.at.I2 = (link.at.I1 * link.at.I1 - trace_C2) / 2;
  }
  if constexpr (need_J) {
    for (int a = 0; a < 3; ++a) {
      const Real* p = e[(a + 1) % 3];
      const Real* q = e[(a + 2) % 3];
      link.cross[a][0] = p[1] * q[2] - p[2] * q[1];
      link.cross[a][1] = p[2] * q[0] - p[0] * q[2];
      link.cross[a][2] = p[0] * q[1] - p[1] * q[0];
    }
    link.at.J = dot(e[0], link.cross[0]) / (6 * volume);
  }
  return link;
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

/// Corner forces of one element into out[12] ([corner][xyz], N). Returns whether the law is defined there.
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline bool corner_forces(const L& law, const Real* x0, const Real* x1, const Real* x2,
                                                 const Real* x3, const Real A[6], Real volume, Real out[12]) {
  const Link<Real> link = read_link<L::uses_I2, L::uses_J>(x0, x1, x2, x3, A, volume);
  const Slopes<Real> s = law.slopes(link.at);
  const Real pull = 2 * volume * (s.w1 + (L::uses_I2 ? s.w2 * link.at.I1 : Real(0)));
  Real T[6];
  for (int i = 0; i < 6; ++i) T[i] = pull * A[i];
  if constexpr (L::uses_I2) {
    Real AGA[6];
    product_AGA(A, link.AG, AGA);
    for (int i = 0; i < 6; ++i) T[i] -= 2 * volume * s.w2 * AGA[i];
  }
  const Real t[3][3] = {{T[0], T[3], T[4]}, {T[3], T[1], T[5]}, {T[4], T[5], T[2]}};
  for (int i = 0; i < 3; ++i) {
    Real sum = 0;
    for (int a = 0; a < 3; ++a) {
      Real f = t[a][0] * link.e[0][i] + t[a][1] * link.e[1][i] + t[a][2] * link.e[2][i];
      if constexpr (L::uses_J) f += s.wJ / 6 * link.cross[a][i];
      out[3 * (a + 1) + i] = -f;
      sum += f;
    }
    out[i] = sum;
  }
  return law.valid(link.at);
}

}  // namespace heml
