#include <doctest/doctest.h>

#include <app/panel/quantity.hpp>
#include <limits>

namespace heml::quantity_test {

using namespace heml::panel;

TEST_CASE("quantities take the prefix that suits and three digits") {
  CHECK(quantity(0, "J") == "0 J");
  CHECK(quantity(1, "J") == "1.00 J");
  CHECK(quantity(-0.00123, "J") == "−1.23 mJ");
  CHECK(quantity(4.56e-5, "s") == "45.6 µs");
  CHECK(quantity(123456, "Pa") == "123 kPa");
  CHECK(quantity(0.9999, "s") == "1.00 s");
  CHECK(quantity(999.9, "J") == "1.00 kJ");
  CHECK(quantity(99.99, "J") == "100 J");
  CHECK(quantity(2e-9, "J") == "2.00 nJ");
  CHECK(quantity(std::numeric_limits<double>::quiet_NaN(), "J") == "–");
  CHECK(quantity(std::numeric_limits<double>::infinity(), "J") == "–");
}

TEST_CASE("forces stay in newtons") {
  CHECK(newtons(0) == "0.000 N");
  CHECK(newtons(0.5714) == "0.571 N");
  CHECK(newtons(0.99991) == "1.00 N");
  CHECK(newtons(12.345) == "12.3 N");
  CHECK(newtons(1234.5) == "1234 N");
}

TEST_CASE("counts are grouped") {
  CHECK(grouped_digits(0) == "0");
  CHECK(grouped_digits(999) == "999");
  CHECK(grouped_digits(1234567) == "1\u00a0234\u00a0567");
  CHECK(grouped_digits(-1000) == "−1\u00a0000");
}

}  // namespace heml::quantity_test
