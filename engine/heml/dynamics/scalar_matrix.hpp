#pragma once
// The scalar matrix aM + L, one number a node, that stands for a body's stiffness in conjugate gradients:
// L_ab = Σ_t V_t c_t g_a·g_b, c a modulus at rest. A mesh's Laplacian bounds its elastic stiffness from both sides
// whatever the size of the mesh, so the iterations do not grow with it. What solves with it (scalar_cholesky.hpp,
// smoothed_prolongation.hpp) takes all three axes at once, in float: a preconditioner needs no more.
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/objective.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <vector>

namespace heml {

using ScalarMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// L, #free square, symmetric, whole. mesh: rest shape, positive volumes. modulus: #T, Pa.
ScalarMatrix scalar_stiffness(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus);

/// M, diagonal, #free square. mass: 3 #V, kg.
ScalarMatrix scalar_mass(const FreeNodes& free, const Vector& mass);

}  // namespace heml
