// Reference solutions against closed forms and published tables.
#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <studies/validation/references.hpp>

namespace heml::validation_references_test {

using namespace heml::validation;

TEST_CASE("validation: the wall of a sphere tends to the closed form of an incompressible one") {
  const double inner = 0.01, outer = 0.02, shear = 1e3;
  for (const double deformed : {0.0101, 0.0125, 0.016}) {
    const double grown = std::pow(deformed, 3) - std::pow(inner, 3);
    const double exact = incompressible_sphere_pressure(shear, inner, outer, deformed);
    const RadialState state =
        radial_state({{shear, 1e7 * shear}, inner, outer, 2}, std::cbrt(std::pow(outer, 3) + grown));
    CHECK(state.inner == doctest::Approx(deformed).epsilon(1e-5));
    CHECK(state.pressure == doctest::Approx(exact).epsilon(1e-4));
  }
}

TEST_CASE("validation: a wall under little pressure is Lame's") {
  const double a = 0.01, b = 0.02, shear = 1e3, bulk = 2e3, pressure = 1e-4 * shear;
  const double lame = bulk - 2 * shear / 3;
  const double sphere =
      pressure * a * a * a / (b * b * b - a * a * a) * (a / (3 * bulk) + b * b * b / (4 * shear * a * a));
  const double tube = pressure * a * a / (b * b - a * a) * (a / (2 * (lame + shear)) + b * b / (2 * shear * a));
  CHECK(radial_state_under({{shear, bulk}, a, b, 2}, pressure).inner - a == doctest::Approx(sphere).epsilon(1e-3));
  CHECK(radial_state_under({{shear, bulk}, a, b, 1}, pressure).inner - a == doctest::Approx(tube).epsilon(1e-3));
  CHECK_THROWS_AS(radial_state_under({{shear, bulk}, a, b, 2}, 10 * shear), std::domain_error);
}

TEST_CASE("validation: the wall is integrated to round-off of its steps") {
  const ThickWall wall{{1e3, 5e5}, 0.01, 0.02, 2};
  CHECK(radial_state(wall, 0.0206, 1000).pressure ==
        doctest::Approx(radial_state(wall, 0.0206, 2000).pressure).epsilon(1e-9));
}

TEST_CASE("validation: the elastica of Mattiasson's table, and of little load") {
  // Mattiasson 1981: across and 1 - along, over the length, at F L2 / EI of 1, 2, 5 and 10.
  constexpr double table[][3] = {
      {1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}, {10, 0.81061, 0.55500}};
  for (const auto& [load, across, shortened] : table) {
    const Elastica beam = elastica_of(load);
    CHECK(beam.across == doctest::Approx(across).epsilon(2e-5));
    CHECK(1 - beam.along == doctest::Approx(shortened).epsilon(1e-4));
  }
  CHECK(elastica_of(1e-3).across == doctest::Approx(1e-3 / 3).epsilon(1e-5));
}

}  // namespace heml::validation_references_test
