#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <heml/elastic/clamp.hpp>

#include "small_body.hpp"
#include "support.hpp"

namespace heml::projection_test {

using namespace heml::test;

namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12, Eigen::RowMajor>;

std::vector<Matrix12> stiffness_of(ElasticBody<double>& body, const std::vector<double>& x, Projection projection) {
  ThreadTeam team(1);
  body.linearise(x.data(), team);
  body.project(projection, team);
  std::vector<Matrix12> result;
  body.each_stiffness([&](const std::array<int, 4>&, const ElementMatrix<double>& K) {
    result.push_back(Eigen::Map<const Matrix12>(&K[0][0]));
  });
  return result;
}

double lowest(const Matrix12& K) { return Eigen::SelfAdjointEigenSolver<Matrix12>(K).eigenvalues()[0]; }

}  // namespace

TEST_CASE("projections leave what is positive and make positive what is not, in every law") {
  std::mt19937_64 random(9);
  for (const auto law : law_names()) {
    CAPTURE(std::string(law));
    SmallBody small(random, 0.15);
    auto body = small.of(law, true);
    const auto exact = stiffness_of(*body, small.x, Projection::none);
    bool any_negative = false;
    for (const Projection projection : {Projection::element, Projection::tension}) {
      const auto positive = stiffness_of(*body, small.x, projection);
      for (std::size_t t = 0; t < exact.size(); ++t) {
        const double size = exact[t].norm();
        CHECK(lowest(positive[t]) >= -1e-12 * size);
        const bool is_positive = lowest(exact[t]) >= -1e-12 * size;
        any_negative |= !is_positive;
        if (is_positive && projection == Projection::element) CHECK((positive[t] - exact[t]).norm() <= 1e-9 * size);
      }
    }
    CHECK(any_negative);
  }
}

TEST_CASE("the inverse of a symmetric matrix") {
  std::mt19937_64 random(31);
  for (int k = 0; k < 20; ++k) {
    double S[6], inverse[6];
    for (double& value : S) value = test::uniform(random, -1, 1);
    S[0] += 3, S[1] += 3, S[2] += 3;
    inverse3(S, inverse);
    Eigen::Matrix3d A, B;
    A << S[0], S[3], S[4], S[3], S[1], S[5], S[4], S[5], S[2];
    B << inverse[0], inverse[3], inverse[4], inverse[3], inverse[1], inverse[5], inverse[4], inverse[5], inverse[2];
    CHECK((A * B - Eigen::Matrix3d::Identity()).norm() < 1e-13);
  }
}

}  // namespace heml::projection_test
