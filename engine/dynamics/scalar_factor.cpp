#include <Eigen/SparseCholesky>
#include <heml/dynamics/scalar_factor.hpp>

namespace heml {

ScalarFactor::ScalarFactor(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus)
    : free_(free) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Tet& tet = mesh.tets[t];
    const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c])]; };
    Mat3 Dm;
    Dm << X(1) - X(0), X(2) - X(0), X(3) - X(0);
    Eigen::Matrix<double, 4, 3> g;
    g.bottomRows<3>() = Dm.inverse();
    g.row(0) = -g.bottomRows<3>().colwise().sum();
    const double scale = modulus[t] * Dm.determinant() / 6;
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const int row = free.number[static_cast<std::size_t>(tet[static_cast<std::size_t>(a)])];
        const int column = free.number[static_cast<std::size_t>(tet[static_cast<std::size_t>(b)])];
        if (column >= 0 && row >= column) entries.emplace_back(row, column, scale * g.row(a).dot(g.row(b)));
      }
  }
  const auto count = static_cast<Eigen::Index>(free.node.size());
  laplacian_.resize(count, count);
  laplacian_.setFromTriplets(entries.begin(), entries.end());
}

bool ScalarFactor::factor(double a, const Vector& mass) {
  Eigen::SparseMatrix<double> matrix = laplacian_;
  for (std::size_t k = 0; k < free_.node.size(); ++k)
    matrix.coeffRef(static_cast<int>(k), static_cast<int>(k)) += a * mass[3 * free_.node[k]];
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> cholesky(matrix);
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

void ScalarFactor::apply(const Vector& r, Vector& z) const {
  const std::size_t count = order_.size();
  const auto node = [&](std::size_t k) { return free_.node[static_cast<std::size_t>(order_[k])]; };
  const double largest = r.cwiseAbs().maxCoeff(), scale = largest > 0 ? largest : 1;  // keeps float in its range
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < 3; ++i) work_[k][i] = static_cast<float>(r[3 * node(k) + static_cast<int>(i)] / scale);
  for (std::size_t j = 0; j < count; ++j) {
    for (std::size_t i = 0; i < 4; ++i) work_[j][i] *= inverse_diagonal_[j];
    const Row y = work_[j];
    for (int k = start_[j]; k < start_[j + 1]; ++k) {
      Row& to = work_[static_cast<std::size_t>(row_[static_cast<std::size_t>(k)])];
      for (std::size_t i = 0; i < 4; ++i) to[i] -= value_[static_cast<std::size_t>(k)] * y[i];
    }
  }
  for (std::size_t j = count; j-- > 0;) {
    Row y = work_[j];
    for (int k = start_[j]; k < start_[j + 1]; ++k) {
      const Row& from = work_[static_cast<std::size_t>(row_[static_cast<std::size_t>(k)])];
      for (std::size_t i = 0; i < 4; ++i) y[i] -= value_[static_cast<std::size_t>(k)] * from[i];
    }
    for (std::size_t i = 0; i < 4; ++i) work_[j][i] = y[i] * inverse_diagonal_[j];
  }
  z.setZero(r.size());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < 3; ++i) z[3 * node(k) + static_cast<int>(i)] = scale * static_cast<double>(work_[k][i]);
}

}  // namespace heml
