#include <doctest/doctest.h>

#include <heml/dynamics/block_jacobi.hpp>

namespace heml::block_jacobi_test {

namespace {

/// Two nodes with rows, of one tetrahedron, with these diagonal blocks.
BsrMatrix matrix_of(const Mat3& first, const Mat3& second) {
  BsrMatrix K({0, -1, 1, -1}, std::vector<Tet>{{0, 1, 2, 3}});
  K.set_zero();
  K.add_node(0, first);
  K.add_node(2, second);
  return K;
}

Mat3 isotropic(double k) { return k * Mat3::Identity(); }

}  // namespace

TEST_CASE("blocks are inverted, and weighed by how much stiffer they are than the stand-in") {
  ThreadTeam team(1);
  Mat3 D;
  D << 4, 1, -1, 1, 5, 0.5, -1, 0.5, 3;  // of trace 12, as the other
  BlockJacobi finest;
  finest.set(matrix_of(D, isotropic(4)), {2, 2}, team);  // (λ + 4μ)/(3μ) = 2, so (λ + 2μ)/μ = 4
  const Eigen::Array4f r(1, -2, 3, 0);
  const Eigen::Vector3f z = finest.apply(0, r).head<3>().matrix();
  const Vec3 back = D * z.cast<double>() / (0.8 * 4);
  CHECK((back - Vec3(1, -2, 3)).norm() < 1e-5);
  CHECK(finest.apply(0, r)[3] == 0);
  CHECK((finest.apply(1, r) - Eigen::Array4f(0.8f, -1.6f, 2.4f, 0)).abs().maxCoeff() < 1e-6f);
}

TEST_CASE("a block that is not positive definite gives way to the stand-in") {
  ThreadTeam team(1);
  const Eigen::Array4f r(1, -2, 3, 0);
  for (const Vec3& eigenvalues : {Vec3(-1, 2, 2), Vec3(2, 2, -1), Vec3(-1, -1, 8), Vec3(0, 0, 0), Vec3(1, 1, 1e-9),
                                  Vec3(std::numeric_limits<double>::quiet_NaN(), 1, 1)}) {
    CAPTURE(eigenvalues.transpose());
    BlockJacobi finest;
    finest.set(matrix_of(eigenvalues.asDiagonal(), isotropic(1)), {4, 1}, team);
    CHECK((finest.apply(0, r) == r / 4).all());
  }
}

TEST_CASE("no weight is below that of a node as stiff as the stand-in") {
  ThreadTeam team(1);
  BlockJacobi finest;
  finest.set(matrix_of(isotropic(1), isotropic(1)), {3, 3}, team);
  CHECK(finest.apply(0, {1, 0, 0, 0})[0] == doctest::Approx(0.8));
}

TEST_CASE("a matrix without rows has nothing to invert") {
  ThreadTeam team(1);
  BlockJacobi finest;
  finest.set(BsrMatrix({-1, -1, -1, -1}, std::vector<Tet>{{0, 1, 2, 3}}), {}, team);
  CHECK(finest.bytes() == 0);
}

}  // namespace heml::block_jacobi_test
