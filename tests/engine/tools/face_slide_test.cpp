#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <heml/tools/face_slide.hpp>
#include <map>

#include "support.hpp"

namespace heml::face_slide_test {

using namespace heml::test;

namespace {

using Corners = std::array<Vec3, 3>;
using Vec9 = Eigen::Matrix<double, 9, 1>;
using Mat9 = Eigen::Matrix<double, 9, 9>;

constexpr double stiffness = 100;  // N/m

std::optional<ContactPoint> contact(const ContactSurface& capsule, const Corners& x) {
  return capsule_face_contact(capsule, {0, 1, 2}, x[0], x[1], x[2], 0);
}

Corners moved(const Corners& x, const Vec9& by) {
  Corners result = x;
  for (int k = 0; k < 3; ++k) result[static_cast<std::size_t>(k)] += by.segment<3>(3 * k);
  return result;
}

/// −∂/∂x of stiffness/2 gap², as forces on the corners.
Vec9 forces(const ContactPoint& point) {
  Vec9 f;
  for (int k = 0; k < 3; ++k)
    f.segment<3>(3 * k) = -stiffness * point.gap * point.weights[static_cast<std::size_t>(k)] * point.normal;
  return f;
}

/// Where the points nearest to each other are: "face", "edge" or "corner", and "end" or "middle" of the axis.
std::string place_of(const ContactSurface& capsule, const ContactPoint& point, const Corners& x) {
  const auto touching = std::count_if(point.weights.begin(), point.weights.end(), [](double w) { return w > 0; });
  Vec3 on_axis = -(point.gap + capsule.radius) * point.normal;
  for (std::size_t k = 0; k < 3; ++k) on_axis += point.weights[k] * x[k];
  const bool at_end = (on_axis - capsule.point).norm() < 1e-9 || (on_axis - capsule.other).norm() < 1e-9;
  return (touching == 3 ? "face, " : touching == 2 ? "edge, " : "corner, ") + std::string(at_end ? "end" : "middle");
}

/// By fourth-order differences of the forces; none where the points nearest to each other change their kind nearby.
std::optional<Mat9> differences(const ContactSurface& capsule, const Corners& x, const std::string& place) {
  constexpr double by = 1e-4;
  Mat9 K;
  for (int i = 0; i < 9; ++i) {
    std::array<Vec9, 4> f;
    const std::array<double, 4> at{2, 1, -1, -2};
    for (std::size_t k = 0; k < 4; ++k) {
      const Corners there = moved(x, at[k] * by * Vec9::Unit(i));
      const auto point = contact(capsule, there);
      if (!point || point->gap <= -capsule.radius || place_of(capsule, *point, there) != place) return std::nullopt;
      f[k] = forces(*point);
    }
    K.col(i) = -(8 * (f[1] - f[2]) - (f[0] - f[3])) / (12 * by);
  }
  return K;
}

/// Of the normal direction and the slides, of either sign or of the positive one.
Mat9 stiffness_of(const ContactSurface& capsule, const ContactPoint& point, const Corners& x, bool positive = false) {
  Vec9 along;
  for (int k = 0; k < 3; ++k) along.segment<3>(3 * k) = point.weights[static_cast<std::size_t>(k)] * point.normal;
  Mat9 K = stiffness * along * along.transpose();
  std::vector<RankOneTerm> slides;
  add_face_slides(capsule, point, x, -stiffness * point.gap, slides);
  for (const RankOneTerm& slide : slides) {
    if (positive && slide.sign < 0) continue;
    Vec9 g;
    for (int k = 0; k < 3; ++k) g.segment<3>(3 * k) = slide.g[static_cast<std::size_t>(k)];
    K += slide.sign * g * g.transpose();
  }
  return K;
}

}  // namespace

TEST_CASE("with slides a contact of a face has the stiffness of its forces") {
  std::mt19937_64 random(31);
  std::map<std::string, int> tried;
  for (int n = 0; n < 3000; ++n) {
    const Corners x{random_vector(random, 1), random_vector(random, 1), random_vector(random, 1)};
    const Vec3 tip = random_vector(random, 1);
    const Vec3 shaft = n % 3 == 0 ? Vec3(Vec3::Zero()) : random_vector(random, 1.5);
    const ContactSurface capsule{ContactSurface::Shape::capsule, tip, tip + shaft, 0.6, 0};
    const auto point = contact(capsule, x);
    if (!point || point->gap < -0.25 || (x[1] - x[0]).cross(x[2] - x[0]).norm() < 0.3) continue;
    const std::string place = place_of(capsule, *point, x);
    const auto expected = differences(capsule, x, place);
    if (!expected) continue;
    CAPTURE(place);
    CHECK((stiffness_of(capsule, *point, x) - *expected).norm() < 1e-6 * expected->norm());
    ++tried[place];
  }
  for (const char* place : {"face, end", "edge, end", "edge, middle", "corner, end", "corner, middle"}) {
    CAPTURE(place);
    CHECK(tried[place] > 20);
  }
}

TEST_CASE("slides of a deep contact stay bounded, and those of positive sign hold no less than its forces") {
  const Corners x{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
  for (const double depth : {0.3, 0.05, 1e-6}) {  // of the axis below the face
    CAPTURE(depth);
    const ContactSurface ball{ContactSurface::Shape::capsule, {0, 0, depth}, {0, 0, depth}, 0.5, 0};
    const auto point = contact(ball, x);
    REQUIRE(point);
    const Mat9 K = stiffness_of(ball, *point, x, true);
    CHECK(K.norm() < 20 * stiffness);
    if (depth < 0.01) continue;  // beyond differences
    const auto exact = differences(ball, x, "face, end");
    REQUIRE(exact);
    const Mat9 over = K - *exact;
    CHECK(over.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() > -1e-7 * K.norm());
  }
}

TEST_CASE("a face that the axis passes through, or that carries no force, has no slides") {
  const Corners x{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)};
  const ContactSurface through{ContactSurface::Shape::capsule, {0, 0, -0.1}, {0, 0, 1}, 0.5, 0};
  const ContactSurface beside{ContactSurface::Shape::capsule, {0, 0, 0.4}, {0, 0, 1}, 0.5, 0};
  std::vector<RankOneTerm> slides;
  add_face_slides(through, *contact(through, x), x, 10, slides);
  add_face_slides(beside, *contact(beside, x), x, 0, slides);
  CHECK(slides.empty());
  add_face_slides(beside, *contact(beside, x), x, 10, slides);
  CHECK(slides.size() == 4);
}

}  // namespace heml::face_slide_test
