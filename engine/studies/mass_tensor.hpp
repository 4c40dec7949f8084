#pragma once
// The Mass-Tensor method for large displacements of Saint Venant–Kirchhoff bodies (Picinbono, Delingette & Ayache
// 2001), which HEML is compared with: equation (3) of Goulette & Chendeb 2006. With U_j = x_j − X_j, the force on p is
//
//   −F^p = Σ_j B_pj U_j + Σ_jk [2 (U_k ⊗ U_j) C_jkp + (U_j·U_k) C_pjk] + 4 Σ_jkl D_jklp (U_k·U_j) U_l
//
// over all j, k, l of {p, N(p)}, the coefficients being sums over tetrahedra of
//
//   B_pj   = V [λ g_p g_jᵀ + μ (g_p·g_j) I + μ g_j g_pᵀ]
//   C_jkp  = V/2 [λ g_j (g_k·g_p) + μ g_k (g_j·g_p) + μ g_p (g_j·g_k)]
//   D_jklp = V/8 [λ (g_j·g_k)(g_l·g_p) + μ (g_j·g_l)(g_k·g_p) + μ (g_k·g_l)(g_j·g_p)]
//
//   node p:  neighbour[ p N(p) … ]  ── each: B
//            pair[ … ]              ── j k, 2 C_jkp, C_pjk, and its
//            triple[ … ]            ── l, 4 D_jklp
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Index sets of the sums of equation (3).
enum class MassTensorSums {
  as_printed,    ///< all pairs and triples of {p, N(p)}, as the paper counts them; most share no tetrahedron
  without_zeros  ///< those that share a tetrahedron with p; the other coefficients are zero
};

/// Real: float, double or CountingScalar.
template <class Real>
class MassTensor {
 public:
  /// mesh: positive volumes. lambda, mu: Pa.
  MassTensor(const TetMesh& mesh, double lambda, double mu, MassTensorSums sums);

  /// Forces at positions x (3 #V, metres) into f (3 #V, overwritten), N.
  void forces(const Real* x, Real* f) const;
  /// B alone: linear elasticity.
  void linear_forces(const Real* x, Real* f) const;

  std::size_t coefficients() const;  ///< numbers stored

 private:
  struct Neighbour {
    int node;
    Real B[3][3];
  };
  struct Pair {
    int j, k;
    Real twice_C[3], C[3];
    std::size_t last_triple;  ///< end of its triples; they begin at the end of the previous pair's
  };
  struct Triple {
    int l;
    Real four_D;
  };
  struct Node {
    std::size_t last_neighbour, last_pair;  ///< ends of its neighbours and pairs
  };

  template <bool linear>
  void sum_forces(const Real* x, Real* f) const;

  std::vector<Real> rest_;  ///< 3 #V
  std::vector<Node> node_;
  std::vector<Neighbour> neighbour_;
  std::vector<Pair> pair_;
  std::vector<Triple> triple_;
};

}  // namespace heml
