#include <doctest/doctest.h>

#include <cmath>
#include <heml/math/elementary.hpp>
#include <heml/math/pack.hpp>
#include <limits>

#include "support.hpp"

namespace heml::elementary_test {

TEST_CASE_TEMPLATE("the logarithm is within 2 units in the last place of one with more digits", Real, float, double) {
  std::mt19937_64 random(1);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double exponent = test::uniform(random, -30, 30), near = test::uniform(random, 0.3, 3);
    const Real x = static_cast<Real>(i % 2 ? std::exp2(exponent) : near);
    const long double exact = std::log(static_cast<long double>(x));
    const long double unit = std::abs(exact) * std::numeric_limits<Real>::epsilon();
    if (unit > 0) worst = std::max(worst, static_cast<double>(std::abs(natural_log(x) - exact) / unit));
  }
  CHECK(worst <= 2.0);
  CHECK(natural_log(Real(1)) == 0);
}

TEST_CASE_TEMPLATE("the exponential is that of one with more digits over its whole range, subnormal values too", Real,
                   float, double) {
  constexpr Real end = max_exponent<Real>, least = std::numeric_limits<Real>::denorm_min();
  const auto error = [](Real x) {  // in units in the last place
    const long double exact = std::exp(static_cast<long double>(x));
    const long double unit = std::max(exact * std::numeric_limits<Real>::epsilon(), static_cast<long double>(least));
    return static_cast<double>(std::abs(natural_exp(x) - exact) / unit);
  };
  std::mt19937_64 random(3);
  double worst = 0, worst_near_end = 0;
  for (int i = 0; i < 100000; ++i) {
    worst = std::max(worst, error(static_cast<Real>(test::uniform(random, -end, end))));
    worst_near_end = std::max(worst_near_end, error(static_cast<Real>(test::uniform(random, -end, -end + 1))));
  }
  CHECK(worst <= 2.0);
  CHECK(worst_near_end <= 2.0);
  CHECK(natural_exp(-end) > 0);
  CHECK(natural_exp(std::nextafter(-end, -2 * end)) == 0);
  struct Family;
  constexpr int lanes = 16 / sizeof(Real);
  using Numbers = Pack<Real, lanes, Family>;
  Numbers several;
  for (int l = 0; l < lanes; ++l) several.v[l] = -end + static_cast<Real>(l) / 8;
  const Numbers powers = natural_exp(several);
  for (int l = 0; l < lanes; ++l) CHECK(powers.v[l] == natural_exp(several.v[l]));
}

TEST_CASE("the cofactor is the gradient of the determinant, of singular matrices too") {
  std::mt19937_64 random(2);
  for (int i = 0; i < 100; ++i) {
    Mat3 F = test::random_gradient(random, 0.2, 3);
    if (i % 4 == 0) F.col(2) = F.col(0) * 2 - F.col(1);
    const double h = 1e-6;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Mat3 up = F, down = F;
        up(r, c) += h;
        down(r, c) -= h;
        CHECK(cofactor(F)(r, c) == doctest::Approx((up.determinant() - down.determinant()) / (2 * h)).epsilon(1e-7));
      }
  }
}

}  // namespace heml::elementary_test
