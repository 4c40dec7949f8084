#include <heml/dynamics/scalar_matrix.hpp>

namespace heml {

ScalarMatrix scalar_stiffness(const FreeNodes& free, const TetMesh& mesh, const std::vector<double>& modulus) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(16 * mesh.tets.size());
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
        if (row >= 0 && column >= 0) entries.emplace_back(row, column, scale * g.row(a).dot(g.row(b)));
      }
  }
  const auto count = static_cast<Eigen::Index>(free.node.size());
  ScalarMatrix L(count, count);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

ScalarMatrix scalar_mass(const FreeNodes& free, const Vector& mass) {
  const auto count = static_cast<Eigen::Index>(free.node.size());
  ScalarMatrix M(count, count);
  M.setIdentity();
  for (Eigen::Index k = 0; k < count; ++k) M.valuePtr()[k] = mass_of_node(mass, free.node[static_cast<std::size_t>(k)]);
  return M;
}

}  // namespace heml
