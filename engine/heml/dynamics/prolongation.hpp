#pragma once
// Coarsening of a symmetric matrix by aggregates of unknowns, and the prolongation from coarse to fine vectors (Vaněk,
// Mandel, Brezina 1996, "Algebraic multigrid by smoothed aggregation for second and fourth order elliptic problems",
// sections 4 and 5).
#include <heml/dynamics/scalar_matrix.hpp>

namespace heml {

/// Row sums of |A|, the diagonal of D, which bound the eigenvalues of D⁻¹A by 1.
std::vector<double> absolute_row_sums(const ScalarMatrix& A);

/// Prolongation from aggregates of strongly connected unknowns, constant on each, then smoothed once by A. #rows of A ×
/// #aggregates.
ScalarMatrix smoothed_prolongation(const ScalarMatrix& A);

}  // namespace heml
