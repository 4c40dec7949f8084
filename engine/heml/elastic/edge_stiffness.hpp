#pragma once
// Element stiffness at one state, evaluated once and multiplied many times: an implicit step takes ten to a hundred
// products with the stiffness of one state, and none of them evaluates the law again.
//
// The forces of an element depend on its edges e_a = x_a − x_0 alone, so its 12×12 stiffness reduces to the symmetric
// 9×9 matrix ∂²U/∂e_a∂e_b, of which the lower half is stored:
//     f_a = −Σ_b K_ab de_b,   f_0 = −(f_1 + f_2 + f_3),   a, b = 1..3
//   packet p:  [45][lanes]     entry (r, c) of the lower half at r(r+1)/2 + c, r = 3(a−1) + i
//
// For a law of invariants it is a sum of outer products of the gradients of the invariants and of multiples of 3×3
// blocks (in the paper's notation K = L(k) ⊗ I + Gᵀ 4V W_ll G, with J in addition to the squared lengths).
#include <heml/elastic/tension.hpp>

namespace heml {

inline constexpr int edge_entries = 45;
constexpr int edge_entry(int r, int c) { return r >= c ? r * (r + 1) / 2 + c : c * (c + 1) / 2 + r; }

/// 12×12 element stiffness, N/m, row-major, indices [corner][xyz].
template <class Real>
using ElementMatrix = Real[12][12];

/// Adds V Σ_kl w_kl p_k p_lᵀ, p_k the gradient of an invariant with respect to the nine coordinates of the edges.
template <int count, class Real>
[[gnu::always_inline]] inline void add_outer_products(const Real (&p)[count][9], const Real (&w)[count][count],
                                                      Real volume, Real K[edge_entries]) {
  Real q[count][9];
  for (int k = 0; k < count; ++k)
    for (int r = 0; r < 9; ++r) {
      Real sum = w[k][0] * p[0][r];
      for (int l = 1; l < count; ++l) sum += w[k][l] * p[l][r];
      q[k][r] = volume * sum;
    }
  for (int r = 0, at = 0; r < 9; ++r)
    for (int c = 0; c <= r; ++c, ++at)
      for (int k = 0; k < count; ++k) K[at] += p[k][r] * q[k][c];
}

/// Σ_a m_a e_a: F a0, or F C a0 with n for m.
template <class Real>
[[gnu::always_inline]] inline void sum_of_edges(const Real m[3], const Real e[3][3], Real out[3]) {
  for (int i = 0; i < 3; ++i) out[i] = m[0] * e[0][i] + m[1] * e[1][i] + m[2] * e[2][i];
}

/// Places of the invariants that a law uses among their gradients: I1, J, then I2, I4 and I5 where it has them.
template <class L>
struct GradientOrder {
  static constexpr bool with_I5 = FibreShearLaw<L>;
  static constexpr int I2 = 2, I4 = L::uses_I2 ? 3 : 2, I5 = 4;
  static constexpr int count = 2 + (L::uses_I2 ? 1 : 0) + (L::uses_I4 ? 1 : 0) + (with_I5 ? 1 : 0);
};

/// Gradients p of the invariants by the coordinates of the edges, and u_a = Σ_b A_ab e_b.
template <class L, class Real>
[[gnu::always_inline]] inline void invariant_gradients(const ElementKinematics<Real>& kinematics,
                                                       const RestShape<Real>& rest, Real u[3][3],
                                                       Real p[GradientOrder<L>::count][9]) {
  using At = GradientOrder<L>;
  const Real* A = rest.A;
  const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
  const auto& e = kinematics.e;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      u[k][i] = a[k][0] * e[0][i] + a[k][1] * e[1][i] + a[k][2] * e[2][i];
      p[0][3 * k + i] = 2 * u[k][i];
      p[1][3 * k + i] = kinematics.cross[k][i] / (6 * rest.volume);
    }
  if constexpr (L::uses_I2)  // ∂I2/∂e_a = 2 (I1 u_a − y_a), y = AGA e
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) {
        const Real y = kinematics.AG[k][0] * u[0][i] + kinematics.AG[k][1] * u[1][i] + kinematics.AG[k][2] * u[2][i];
        p[At::I2][3 * k + i] = 2 * (kinematics.at.I1 * u[k][i] - y);
      }
  Real along[3];
  if constexpr (L::uses_I4) {
    sum_of_edges(rest.fibre, e, along);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i) p[At::I4][3 * k + i] = 2 * rest.fibre[k] * along[i];
  }
  if constexpr (At::with_I5) {  // ∂I5/∂e_a = 2 (n_a F a0 + m_a F C a0)
    Real turned[3];
    sum_of_edges(kinematics.n, e, turned);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        p[At::I5][3 * k + i] = 2 * (kinematics.n[k] * along[i] + rest.fibre[k] * turned[i]);
  }
}

/// Adds factor · ½ ∂²I5 without the part in the tensions: (dG m)·A (dG m), where dG m = de_a·F a0 + e_a·Σ_b m_b de_b.
template <class Real>
[[gnu::always_inline]] inline void add_fibre_shear_stiffness(const ElementKinematics<Real>& kinematics,
                                                             const RestShape<Real>& rest, const Real u[3][3],
                                                             Real factor, Real K[edge_entries]) {
  constexpr int pair[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  const Real *A = rest.A, *m = rest.fibre;
  Real along[3], FF[3][3];
  sum_of_edges(m, kinematics.e, along);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      FF[i][j] = u[0][i] * kinematics.e[0][j] + u[1][i] * kinematics.e[1][j] + u[2][i] * kinematics.e[2][j];
  for (int r = 0, at = 0; r < 9; ++r)
    for (int c = 0; c <= r; ++c, ++at) {
      const int k = r / 3, i = r % 3, l = c / 3, j = c % 3;
      K[at] += factor * (A[pair[k][l]] * along[i] * along[j] + along[i] * m[l] * u[k][j] + m[k] * u[l][i] * along[j] +
                         m[k] * m[l] * FF[i][j]);
    }
}

/// Adds the stiffness of a law of invariants except the geometric part, T_ab I and wJ ∂²J.
template <class Real, InvariantLaw<Real> L>
[[gnu::always_inline]] inline void add_material_stiffness(const L& law, const ElementKinematics<Real>& kinematics,
                                                          const RestShape<Real>& rest, Real K[edge_entries]) {
  const FirstDerivatives<Real> s = law.first_derivatives(kinematics.at);
  const SecondDerivatives<Real> c = law.second_derivatives(kinematics.at);
  const Real* A = rest.A;
  const Real a[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
  using At = GradientOrder<L>;
  constexpr int I2 = At::I2, I4 = At::I4, I5 = At::I5;
  Real u[3][3], p[At::count][9], w[At::count][At::count] = {{c.w11, c.w1J}, {c.w1J, c.wJJ}};
  invariant_gradients<L>(kinematics, rest, u, p);
  if constexpr (L::uses_I2) {
    // ∂²I2 = 4 u_a u_bᵀ − 2 u_b u_aᵀ − 2 A_ab FFᵀ + a part in the tensions.
    Real FF[6] = {0, 0, 0, 0, 0, 0};
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int k = 0; k < 3; ++k)
      for (int m = 0; m < 6; ++m) FF[m] += u[k][row[m]] * kinematics.e[k][column[m]];
    w[0][I2] = w[I2][0] = c.w12;
    w[1][I2] = w[I2][1] = c.w2J;
    w[I2][I2] = c.w22;
    w[0][0] += s.w2;
    const Real twice = 2 * rest.volume * s.w2;
    const Real B[3][3] = {{FF[0], FF[3], FF[4]}, {FF[3], FF[1], FF[5]}, {FF[4], FF[5], FF[2]}};
    for (int r = 0, at = 0; r < 9; ++r)
      for (int col = 0; col <= r; ++col, ++at) {
        const int k = r / 3, i = r % 3, l = col / 3, j = col % 3;
        K[at] -= twice * (a[k][l] * B[i][j] + u[l][i] * u[k][j]);
      }
  }
  if constexpr (L::uses_I4) {
    w[0][I4] = w[I4][0] = c.w14;
    w[1][I4] = w[I4][1] = c.w4J;
    if constexpr (L::uses_I2) w[I2][I4] = w[I4][I2] = c.w24;
    w[I4][I4] = c.w44;
  }
  if constexpr (At::with_I5) {
    const Real second[4] = {c.w15, c.w5J, c.w25, c.w45};
    for (int k = 0; k < I5; ++k) w[k][I5] = w[I5][k] = second[k];
    w[I5][I5] = c.w55;
    add_fibre_shear_stiffness(kinematics, rest, u, 2 * rest.volume * s.w5, K);
  }
  add_outer_products(p, w, rest.volume, K);
}

/// Adds the geometric stiffness T_ab I + V wJ ∂²J/∂e_a∂e_b; second derivatives of the triple product are edges.
template <class Real>
[[gnu::always_inline]] inline void add_geometric_stiffness(const Tensions<Real>& t, const Real e[3][3],
                                                           Real K[edge_entries]) {
  constexpr int pair[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l <= k; ++l)
      for (int i = 0; i < 3; ++i) K[edge_entry(3 * k + i, 3 * l + i)] += t.T[pair[k][l]];
  const Real h = t.wJ / 6;
  for (int k = 1; k < 3; ++k)
    for (int l = 0; l < k; ++l) {
      const int other = 3 - k - l;
      const Real sign = other == 1 ? -h : h;  // of [e_other]×
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, m = (i + 2) % 3;
        K[edge_entry(3 * k + m, 3 * l + j)] += sign * e[other][i];
        K[edge_entry(3 * k + j, 3 * l + m)] -= sign * e[other][i];
      }
    }
}

/// Adds the stiffness by columns: change(de, out[12]) writes the change of the corner forces with a unit change de of
/// the edges.
template <class Change, class Real>
[[gnu::always_inline]] inline void add_columns(const Change& change, Real K[edge_entries]) {
  for (int c = 0; c < 9; ++c) {
    Real de[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, f[12];
    de[c / 3][c % 3] = 1;
    change(de, f);
    for (int r = c; r < 9; ++r) K[edge_entry(r, c)] -= f[r + 3];
  }
}

/// Adds the stiffness of a law at one element. kinematics: of law_kinematics().
template <class Real, Law<Real> L>
[[gnu::always_inline]] inline void add_edge_stiffness(const L& law, const ElementKinematics<Real>& kinematics,
                                                      const RestShape<Real>& rest, Real K[edge_entries]) {
  const Tensions<Real> t = tensions(law, kinematics, rest);
  if constexpr (PrincipalLaw<L, Real>) {
    const PrincipalTangent<Real, L> tangent(law, kinematics, rest);
    add_columns(
        [&](const Real(&de)[3][3], Real* f) {
          corner_force_differential(t, tangent(kinematics_differential(kinematics, de, rest.volume)), kinematics, de,
                                    f);
        },
        K);
  } else {
    add_material_stiffness(law, kinematics, rest, K);
    add_geometric_stiffness(t, kinematics.e, K);
  }
}

/// Expands to the 12×12 form. Moving corner 0 moves all edges by the opposite.
template <class Real>
void expand_edges(const Real K[edge_entries], ElementMatrix<Real>& out) {
  for (std::size_t r = 0; r < 9; ++r)
    for (std::size_t c = 0; c < 9; ++c) out[3 + r][3 + c] = K[edge_entry(static_cast<int>(r), static_cast<int>(c))];
  for (std::size_t r = 3; r < 12; ++r)
    for (std::size_t i = 0; i < 3; ++i) out[r][i] = out[i][r] = -(out[r][3 + i] + out[r][6 + i] + out[r][9 + i]);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out[i][j] = -(out[3 + i][j] + out[6 + i][j] + out[9 + i][j]);
}

}  // namespace heml
