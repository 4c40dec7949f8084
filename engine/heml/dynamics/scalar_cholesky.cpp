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
  const std::size_t count = order_.size();
  for (std::size_t k = 0; k < count; ++k) work_[k] = b[static_cast<std::size_t>(order_[k])];
  for (std::size_t j = 0; j < count; ++j) {
    const Eigen::Array4f y = work_[j] *= inverse_diagonal_[j];
    for (int k = start_[j]; k < start_[j + 1]; ++k)
      work_[static_cast<std::size_t>(row_[static_cast<std::size_t>(k)])] -= value_[static_cast<std::size_t>(k)] * y;
  }
  for (std::size_t j = count; j-- > 0;) {
    Eigen::Array4f y = work_[j];
    for (int k = start_[j]; k < start_[j + 1]; ++k)
      y -= value_[static_cast<std::size_t>(k)] * work_[static_cast<std::size_t>(row_[static_cast<std::size_t>(k)])];
    work_[j] = y * inverse_diagonal_[j];
  }
  for (std::size_t k = 0; k < count; ++k) b[static_cast<std::size_t>(order_[k])] = work_[k];
}

}  // namespace heml
