#pragma once
// A Cholesky factor of a symmetric sparse matrix, kept in float, whose back-solves run three right-hand sides at once.
#include <heml/dynamics/scalar_matrix.hpp>
#include <heml/math/bytes.hpp>

namespace heml {

class ScalarCholesky {
 public:
  /// A: symmetric. Returns whether it is positive definite; nothing is solved with one that is not.
  bool factor(const ScalarMatrix& A);

  /// b = A⁻¹ b for each axis.
  void solve(MultiVector& b) const;

  std::size_t bytes() const { return bytes_of(order_, start_, row_, value_, inverse_diagonal_, work_); }

 private:
  std::vector<int> order_;        ///< unknown eliminated k-th
  std::vector<int> start_, row_;  ///< by columns, diagonal left out
  std::vector<float> value_, inverse_diagonal_;
  mutable MultiVector work_;  ///< in the order of elimination
};

}  // namespace heml
