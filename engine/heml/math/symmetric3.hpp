#pragma once
// Symmetric 3×3 matrices as six numbers 11 22 33 12 13 23, and their eigenvalues by Jacobi rotations: branch-free, so
// that loops over elements vectorise, and accurate for equal eigenvalues too.
#include <array>
#include <cmath>
#include <heml/math/scalar.hpp>

namespace heml {

template <class Real>
struct SymmetricEigen3 {
  Real value[3];
  Real vector[3][3];  ///< vector[i] belongs to value[i]; orthonormal
};

/// All eigenvalues and eigenvectors, in no particular order; five sweeps of cyclic Jacobi (Golub & Van Loan, 8.5).
template <class Real>
[[gnu::always_inline]] inline SymmetricEigen3<Real> symmetric_eigen3(const Real S[6]) {
  using std::sqrt;  // other scalar types provide theirs
  Real a[3][3] = {{S[0], S[3], S[4]}, {S[3], S[1], S[5]}, {S[4], S[5], S[2]}};
  Real v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // columns are the vectors
  constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
  for (int sweep = 0; sweep < 5; ++sweep)
    for (const auto& pair : pairs) {
      const int p = pair[0], q = pair[1], r = 3 - p - q;
      const Real difference = a[q][q] - a[p][p], twice = 2 * a[p][q];
      const Real root = sqrt(difference * difference + twice * twice);
      const Real below = difference + select(difference < 0, -root, root);
      const Real t = select(below == 0, select(twice == 0, Real(0), Real(1)), twice / below);
      const Real c = 1 / sqrt(1 + t * t), s = t * c;
      const Real apq = a[p][q], arp = a[r][p], arq = a[r][q];
      a[p][p] -= t * apq;
      a[q][q] += t * apq;
      a[p][q] = a[q][p] = 0;
      a[r][p] = a[p][r] = c * arp - s * arq;
      a[r][q] = a[q][r] = s * arp + c * arq;
      for (auto& row : v) {
        const Real vp = row[p], vq = row[q];
        row[p] = c * vp - s * vq;
        row[q] = s * vp + c * vq;
      }
    }
  SymmetricEigen3<Real> e;
  for (int i = 0; i < 3; ++i) {
    e.value[i] = a[i][i];
    for (int k = 0; k < 3; ++k) e.vector[i][k] = v[k][i];
  }
  return e;
}

/// S⁻¹ of a symmetric matrix that is not singular.
template <class Real>
[[gnu::always_inline]] inline void inverse3(const Real S[6], Real out[6]) {
  const Real c[6] = {S[1] * S[2] - S[5] * S[5], S[0] * S[2] - S[4] * S[4], S[0] * S[1] - S[3] * S[3],
                     S[4] * S[5] - S[3] * S[2], S[3] * S[5] - S[1] * S[4], S[3] * S[4] - S[0] * S[5]};
  const Real scale = 1 / (S[0] * c[0] + S[3] * c[3] + S[4] * c[4]);
  for (int i = 0; i < 6; ++i) out[i] = scale * c[i];
}

/// Σ_i f_i n_i n_iᵀ.
template <class Real>
[[gnu::always_inline]] inline void spectral_sum3(const SymmetricEigen3<Real>& e, const Real f[3], Real out[6]) {
  constexpr int row[6] = {0, 1, 2, 0, 0, 1}, col[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < 6; ++k) {
    out[k] = 0;
    for (int i = 0; i < 3; ++i) out[k] += f[i] * e.vector[i][row[k]] * e.vector[i][col[k]];
  }
}

/// A:B of two symmetric matrices.
template <class Real>
[[gnu::always_inline]] inline Real double_contraction3(const Real a[6], const Real b[6]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + 2 * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5]);
}

/// n·(S m).
template <class Real>
[[gnu::always_inline]] inline Real bilinear3(const Real n[3], const Real S[6], const Real m[3]) {
  return n[0] * (S[0] * m[0] + S[3] * m[1] + S[4] * m[2]) + n[1] * (S[3] * m[0] + S[1] * m[1] + S[5] * m[2]) +
         n[2] * (S[4] * m[0] + S[5] * m[1] + S[2] * m[2]);
}

/// S m.
template <class Real>
[[gnu::always_inline]] inline void times3(const Real S[6], const Real m[3], Real out[3]) {
  out[0] = S[0] * m[0] + S[3] * m[1] + S[4] * m[2];
  out[1] = S[3] * m[0] + S[1] * m[1] + S[5] * m[2];
  out[2] = S[4] * m[0] + S[5] * m[1] + S[2] * m[2];
}

/// M S Mᵀ of a general M and a symmetric S.
template <class Real>
[[gnu::always_inline]] inline void congruence3(const Real M[3][3], const Real S[6], Real out[6]) {
  out[0] = bilinear3(M[0], S, M[0]);
  out[1] = bilinear3(M[1], S, M[1]);
  out[2] = bilinear3(M[2], S, M[2]);
  out[3] = bilinear3(M[0], S, M[1]);
  out[4] = bilinear3(M[0], S, M[2]);
  out[5] = bilinear3(M[1], S, M[2]);
}

}  // namespace heml
