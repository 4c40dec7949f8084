#include "naive_forces.hpp"

#include <algorithm>
#include <heml/materials/law_list.hpp>

namespace heml::bench {
namespace {

using Matrix = double[3][3];

/// S = 2 ∂W/∂C at fixed J and wJ, from C and J.
template <class L>
inline double stress(const L& law, const Matrix& C, double J, const double fibre[3], Matrix& S) {
  if constexpr (PrincipalLaw<L, double>) {
    const double six[6] = {C[0][0], C[1][1], C[2][2], C[0][1], C[0][2], C[1][2]};
    const auto result = principal_stress(law, principal_state<L::is_continued>(law, six, J), J);
    const double* s = result.S;
    const Matrix full = {{s[0], s[3], s[4]}, {s[3], s[1], s[5]}, {s[4], s[5], s[2]}};
    std::copy(&full[0][0], &full[0][0] + 9, &S[0][0]);
    return result.wJ;
  } else {
    Invariants<double> at{C[0][0] + C[1][1] + C[2][2], 0, J, 1};
    if constexpr (L::uses_I2) {
      double square = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) square += C[i][j] * C[i][j];
      at.I2 = (at.I1 * at.I1 - square) / 2;
    }
    if constexpr (L::uses_I4) {
      at.I4 = 0;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) at.I4 += fibre[i] * C[i][j] * fibre[j];
    }
    const auto s = law.slopes(at);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        S[i][j] = i == j ? 2 * s.w1 : 0;
        if constexpr (L::uses_I2) S[i][j] += 2 * s.w2 * ((i == j ? at.I1 : 0) - C[i][j]);
        if constexpr (L::uses_I4) S[i][j] += 2 * s.w4 * fibre[i] * fibre[j];
      }
    return s.wJ;
  }
}

template <class L>
void forces(const void* any, const NaiveMesh& mesh, const double* x, double* f, std::size_t nodes) {
  const L& law = *static_cast<const L*>(any);
  std::fill(f, f + 3 * nodes, 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& tet = mesh.tets[t];
    const auto& B = mesh.inverse[t];
    Matrix Ds, F, C, S, P, cof;
    for (int i = 0; i < 3; ++i)
      for (int a = 0; a < 3; ++a) Ds[i][a] = x[3 * tet[static_cast<std::size_t>(a) + 1] + i] - x[3 * tet[0] + i];
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) F[i][j] = Ds[i][0] * B[j] + Ds[i][1] * B[3 + j] + Ds[i][2] * B[6 + j];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) C[i][j] = F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
    double J = 1;
    if constexpr (L::uses_J) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
          cof[i][j] = F[a][c] * F[b][d] - F[a][d] * F[b][c];
        }
      J = F[0][0] * cof[0][0] + F[0][1] * cof[0][1] + F[0][2] * cof[0][2];
    }
    const double wJ = stress(law, C, J, mesh.fibre, S);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        P[i][j] = F[i][0] * S[0][j] + F[i][1] * S[1][j] + F[i][2] * S[2][j];
        if constexpr (L::uses_J) P[i][j] += wJ * cof[i][j];
      }
    for (std::size_t a = 0; a < 3; ++a)
      for (int i = 0; i < 3; ++i) {
        const double h = mesh.volume[t] * (P[i][0] * B[3 * a] + P[i][1] * B[3 * a + 1] + P[i][2] * B[3 * a + 2]);
        f[3 * tet[a + 1] + i] -= h;
        f[3 * tet[0] + i] += h;
      }
  }
}

}  // namespace

NaiveForces naive_forces(std::size_t law) {
  return [&]<std::size_t... k>(std::index_sequence<k...>) {
    NaiveForces found = nullptr;
    ((k == law ? void(found = forces<typename std::tuple_element_t<k, LawList>::template Law<double, false>>) : void()),
     ...);
    return found;
  }
  (std::make_index_sequence<std::tuple_size_v<LawList>>{});
}

}  // namespace heml::bench
