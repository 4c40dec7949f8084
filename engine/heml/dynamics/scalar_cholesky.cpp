#include <Eigen/SparseCholesky>
#include <heml/dynamics/scalar_cholesky.hpp>

namespace heml {

bool ScalarCholesky::factor(const ScalarMatrix& A) {
  if (A.rows() == 0) {  // definite, and nothing to solve
    *this = ScalarCholesky();
    return true;
  }
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky(A);
  if (cholesky.info() != Eigen::Success) return false;
  const auto& L = cholesky.matrixL().nestedExpression();
  const auto& inverse_order = cholesky.permutationPinv().indices();
  order_.assign(inverse_order.data(), inverse_order.data() + inverse_order.size());
  start_.assign(1, 0);
  row_.clear();
  value_.clear();
  inverse_diagonal_.clear();
  for (int column = 0; column < L.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(L, column); entry; ++entry) {
      if (entry.row() == column) {
        inverse_diagonal_.push_back(static_cast<float>(1 / entry.value()));
      } else {
        row_.push_back(static_cast<int>(entry.row()));
        value_.push_back(static_cast<float>(entry.value()));
      }
    }
    start_.push_back(static_cast<int>(row_.size()));
  }
  work_.resize(order_.size());
  return true;
}

void ScalarCholesky::solve(MultiVector& b) const {
  using Four = Eigen::Array4f;
  const std::size_t count = order_.size();
  for (std::size_t k = 0; k < count; ++k) work_[k] = b[static_cast<std::size_t>(order_[k])];
  // Pointers of this function's own, which no store of the loops may change.
  Four* const x = work_.data();
  const int *const start = start_.data(), *const row = row_.data();
  const float *const value = value_.data(), *const inverse_diagonal = inverse_diagonal_.data();
  for (std::size_t j = 0; j < count; ++j) {
    const Four y = x[j] * inverse_diagonal[j];
    x[j] = y;
    for (int k = start[j]; k < start[j + 1]; ++k) x[row[k]] -= value[k] * y;
  }
  for (std::size_t j = count; j-- > 0;) {
    // Four sums side by side: one alone waits for each addition before the next.
    Four sum[4] = {x[j], Four::Zero(), Four::Zero(), Four::Zero()};
    int k = start[j];
    for (; k + 4 <= start[j + 1]; k += 4)
      for (int l = 0; l < 4; ++l) sum[l] -= value[k + l] * x[row[k + l]];
    for (; k < start[j + 1]; ++k) sum[0] -= value[k] * x[row[k]];
    x[j] = ((sum[0] + sum[1]) + (sum[2] + sum[3])) * inverse_diagonal[j];
  }
  for (std::size_t k = 0; k < count; ++k) b[static_cast<std::size_t>(order_[k])] = work_[k];
}

}  // namespace heml
