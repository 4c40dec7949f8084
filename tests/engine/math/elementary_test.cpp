#include <doctest/doctest.h>

#include <cmath>
#include <heml/math/elementary.hpp>
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
