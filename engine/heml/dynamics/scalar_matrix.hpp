#pragma once
// The scalar matrix aM + L, one number per node, which preconditions the stiffness of a body in conjugate gradients:
// L_ab = Σ_t V_t c_t g_a·g_b, c a modulus at rest. The Laplacian of a mesh bounds its elastic stiffness from both sides
// independently of the mesh size, so the number of iterations does not grow with the mesh. Its solvers
// (scalar_cholesky.hpp, smoothed_aggregation.hpp) treat the three axes at once, in float, which suffices for a
// preconditioner.
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <heml/dynamics/block_matrix.hpp>
#include <heml/dynamics/objective.hpp>
#include <heml/elastic/bsr_matrix.hpp>
#include <vector>

namespace heml {

using ScalarMatrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// L (N/m), #free square, symmetric, both halves stored. mesh: rest shape, positive volumes. modulus: #T, Pa.
ScalarMatrix scalar_stiffness(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus);

/// M (kg), diagonal, #free square. mass: 3 #V, kg.
ScalarMatrix scalar_mass(const FreeNodes& free, const Vector& mass);

}  // namespace heml
