#pragma once
// The prefactored scalar matrix aM + L, one number a node, that stands for a body's stiffness in conjugate gradients:
// L_ab = Σ_t V_t c_t g_a·g_b, c a modulus at rest. A mesh's Laplacian bounds its elastic stiffness from both sides
// whatever the size of the mesh, so the iterations do not grow with it; and it is factored once, not once a step.
//
// The factor is kept in float, its back-solves run all three axes at once: a preconditioner needs no more.
#include <Eigen/SparseCore>
#include <array>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/objective.hpp>
#include <vector>

namespace heml {

class ScalarFactor {
 public:
  /// mesh: rest shape, positive volumes. modulus: #T, Pa. free must outlive this.
  ScalarFactor(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus);

  /// Factors aM + L. a: 1/s². mass: 3 #V, kg. Returns whether it is positive definite.
  bool factor(double a, const Vector& mass);

  /// z = (aM + L)⁻¹ r for each axis (3 #V); 0 at nodes that are not free.
  void apply(const Vector& r, Vector& z) const;

 private:
  using Row = std::array<float, 4>;  ///< xyz and padding: one vector register

  const FreeNodes& free_;
  Eigen::SparseMatrix<double> laplacian_;  ///< #free square, lower half
  std::vector<int> order_;                 ///< unknown eliminated k-th
  std::vector<int> start_, row_;           ///< factor by columns, diagonal left out
  std::vector<float> value_, inverse_diagonal_;
  mutable std::vector<Row> work_;
};

}  // namespace heml
