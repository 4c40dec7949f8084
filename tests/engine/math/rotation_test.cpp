#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/math/rotation.hpp>
#include <numbers>

#include "support.hpp"

namespace heml::rotation_test {

namespace {
/// How far a value is from one of more digits, in units of its last place.
double error(double value, long double exact) {
  const double unit = std::nextafter(std::abs(value), 1e300) - std::abs(value);
  return static_cast<double>(std::abs(value - exact)) / unit;
}
}  // namespace

TEST_CASE("sine and cosine are rounded from more digits, to half a unit in the last place and a thousandth") {
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    const double size = i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 13 : 1e6;
    const double angle = test::uniform(random, -size, size);
    const auto [s, c] = sine_cosine(angle);
    worst = std::max({worst, error(s, std::sin(static_cast<long double>(angle))),
                      error(c, std::cos(static_cast<long double>(angle)))});
  }
  CHECK(worst <= 0.501);
}

TEST_CASE("sine and cosine of no angle are exact, and those of quarters what their rounding leaves") {
  CHECK(sine_cosine(0).sine == 0);
  CHECK(sine_cosine(0).cosine == 1);
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const double angle = quarter * std::numbers::pi / 2;
    const auto [s, c] = sine_cosine(angle);
    CHECK(s == static_cast<double>(std::sin(static_cast<long double>(angle))));
    CHECK(c == static_cast<double>(std::cos(static_cast<long double>(angle))));
  }
  CHECK(std::isnan(sine_cosine(std::numeric_limits<double>::infinity()).sine));
}

TEST_CASE("a rotation turns by the right hand about its axis, and keeps lengths") {
  CHECK((rotation_matrix(Vec3::UnitZ(), std::numbers::pi / 2) * Vec3::UnitX() - Vec3::UnitY()).norm() < 1e-15);
  CHECK(rotation_matrix(Vec3::UnitX(), 0) == Mat3::Identity());
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 axis = (test::random_vector(random, 1) + Vec3(0, 0, 1.5)).normalized();
    const double angle = test::uniform(random, -20, 20);
    const Mat3 R = rotation_matrix(axis, angle);
    CHECK((R * axis - axis).norm() < 4e-15);
    CHECK((R * R.transpose() - Mat3::Identity()).norm() < 4e-15);
    CHECK(R.trace() == doctest::Approx(1 + 2 * std::cos(angle)));
    const Vec3 x = axis.unitOrthogonal();
    CHECK(axis.dot(x.cross(R * x)) == doctest::Approx(std::sin(angle)));
  }
}

}  // namespace heml::rotation_test
