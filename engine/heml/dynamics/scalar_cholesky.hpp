#pragma once
// Cholesky factor of a symmetric sparse matrix, stored in float, that solves three right-hand sides at once.
#include <heml/dynamics/scalar_matrix.hpp>
#include <heml/math/bytes.hpp>

namespace heml {

class ScalarCholesky {
 public:
  /// Factors a symmetric A. Returns false and keeps the previous factor if A is not positive definite.
  bool factor(const ScalarMatrix& A);

  /// b = A⁻¹ b for each axis, b: #rows. Uses scratch memory: one call at a time.
  void solve(MultiVector& b) const;

  std::size_t bytes() const { return bytes_of(order_, start_, row_, value_, inverse_diagonal_, work_); }

 private:
  std::vector<int> order_;        ///< the unknown eliminated k-th
  std::vector<int> start_, row_;  ///< of L by columns, without the diagonal
  std::vector<float> value_, inverse_diagonal_;
  mutable MultiVector work_;  ///< in the order of elimination
};

}  // namespace heml
