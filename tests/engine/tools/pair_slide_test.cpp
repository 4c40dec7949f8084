#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <heml/tools/pair_slide.hpp>

#include "support.hpp"

namespace heml::pair_slide_test {

using namespace heml::test;

namespace {

using Places = std::array<Vec3, 4>;
using Vec12 = Eigen::Matrix<double, 12, 1>;
using Mat12 = Eigen::Matrix<double, 12, 12>;

constexpr double stiffness = 100;  // N/m
constexpr std::array<int, 4> nodes{0, 1, 2, 3};

/// −∂/∂x of stiffness/2 gap².
Vec12 forces(int side, const Places& x) {
  const auto point = point_of(ContactPair{nodes, side}, x);
  REQUIRE(point);
  Vec12 f;
  for (int k = 0; k < 4; ++k)
    f.segment<3>(3 * k) = -stiffness * point->gap * point->weights[static_cast<std::size_t>(k)] * point->normal;
  return f;
}

Mat12 differences(int side, const Places& x) {
  constexpr double by = 1e-6;
  Mat12 K;
  for (int i = 0; i < 12; ++i) {
    const auto at = [&](double step) {
      Places there = x;
      there[static_cast<std::size_t>(i / 3)][i % 3] += step;
      return forces(side, there);
    };
    K.col(i) = -(at(by) - at(-by)) / (2 * by);
  }
  return K;
}

Mat12 sum_of(const std::vector<RankOneTerm>& terms) {
  Mat12 K = Mat12::Zero();
  for (const RankOneTerm& term : terms) {
    Vec12 g;
    for (int k = 0; k < 4; ++k) g.segment<3>(3 * k) = term.g[static_cast<std::size_t>(k)];
    K += term.sign * g * g.transpose();
  }
  return K;
}

/// A node 1e-5 behind a face, or an edge behind another, of size 1, shaken and turned.
Places touching(int side, std::mt19937_64& random) {
  constexpr double depth = 1e-5;
  Places x = side == 0
                 ? Places{Vec3(0.3, 0.2, -depth), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}
                 : Places{Vec3(-0.4, 0, -side * depth), Vec3(0.6, 0, -side * depth), Vec3(0, -0.3, 0), Vec3(0, 0.7, 0)};
  for (Vec3& place : x) place.head<2>() += 0.1 * Eigen::Vector2d(uniform(random, -1, 1), uniform(random, -1, 1));
  const Vec3 axis(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
  const Mat3 turn = Eigen::AngleAxisd(uniform(random, 0, 3), axis.normalized()).toRotationMatrix();
  for (Vec3& place : x) place = turn * place;
  return x;
}

}  // namespace

TEST_CASE("slides of a pair are the slope of its force beside that of its gap, of either sign") {
  std::mt19937_64 random(7);
  for (const int side : {0, 1, -1})
    for (int k = 0; k < 20; ++k) {
      const Places x = touching(side, random);
      const ContactPoint point = *point_of(ContactPair{nodes, side}, x);
      REQUIRE(point.gap < 0);
      Vec12 along;
      for (int n = 0; n < 4; ++n) along.segment<3>(3 * n) = point.weights[static_cast<std::size_t>(n)] * point.normal;
      const Mat12 rest = differences(side, x) - stiffness * along * along.transpose();
      std::vector<RankOneTerm> terms;
      add_pair_slides(side, point, x, -stiffness * point.gap, terms);
      REQUIRE(terms.size() == 4);
      CHECK(rest.norm() > 1e-4);
      CHECK((sum_of(terms) - rest).norm() < 1e-3 * rest.norm());
      CHECK(rest.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() < -0.1 * rest.norm());
    }
}

TEST_CASE("a pair that does not press has no slides") {
  std::mt19937_64 random(8);
  const Places x = touching(0, random);
  std::vector<RankOneTerm> terms;
  add_pair_slides(0, *point_of(ContactPair{nodes, 0}, x), x, 0, terms);
  CHECK(terms.empty());
}

}  // namespace heml::pair_slide_test
