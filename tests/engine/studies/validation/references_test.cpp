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

TEST_CASE("validation: a linear solid under strain of constant speed is its integral over the past") {
  // ∫ G(t − s) ds over the time of loading, by the midpoint rule; then held.
  const std::vector<Branch> branches{{0.5, 0.1}, {2, 0.7}};
  const double shear = 3e3, speed = 0.4;
  const auto modulus = [&](double t) { return shear * (1 + 0.5 * std::exp(-t / 0.1) + 2 * std::exp(-t / 0.7)); };
  LinearSolid solid(shear, branches);
  for (int k = 0; k < 3; ++k) solid.stress_after(speed * 0.1, 0.1);
  const double held = solid.stress_after(0, 0.2);
  double integral = 0;
  constexpr int parts = 10000;
  for (int i = 0; i < parts; ++i) integral += modulus(0.5 - 0.3 * (i + 0.5) / parts) * speed * 0.3 / parts;
  CHECK(held == doctest::Approx(integral).epsilon(1e-8));
}

TEST_CASE("validation: creep under constant stress is the strain whose relaxation keeps that stress") {
  const Rubber at_last{2e3, 9e3};
  const Branch branch{0.8, 0.2};
  const double stress = 5;
  CHECK(creep_strain(stress, at_last, branch, 0) ==
        doctest::Approx(stress * (1 / (3 * 2e3 * 1.8) + 1 / (9 * 9e3))).epsilon(1e-12));
  // In shear: three times what is beyond the bulk's part is the strain of a stress σ; fed to the linear solid it gives
  // that stress at all times.
  LinearSolid solid(at_last.shear, {branch});
  double before = 0, found = 0;
  const auto shear_strain = [&](double t) {
    return 3 * (creep_strain(stress, at_last, branch, t) - stress / (9 * at_last.bulk));
  };
  found = solid.stress_after(shear_strain(0), 1e-12);
  before = shear_strain(0);
  CHECK(found == doctest::Approx(stress).epsilon(1e-9));
  for (int k = 1; k <= 2000; ++k) {
    found = solid.stress_after(shear_strain(5e-4 * k) - before, 5e-4);
    before = shear_strain(5e-4 * k);
  }
  CHECK(found == doctest::Approx(stress).epsilon(1e-6));
}

TEST_CASE("validation: a yielding solid flows at the slopes of its closed form, and hardens both ways") {
  const double shear = 4e3, yield = 20 * std::sqrt(3.0),
               hardening = 3e3;  // yields at 20 Pa; μ H/3 / (μ + H/3) = 800 Pa
  PlasticShear once(shear, yield, hardening), in_parts(shear, yield, hardening);
  const double up = once.stress_after(0.02);
  double parts = 0;
  for (int k = 0; k < 400; ++k) parts = in_parts.stress_after(0.02 / 400);
  CHECK(up == doctest::Approx(20 + 800 * 0.015).epsilon(1e-12));
  CHECK(parts == doctest::Approx(up).epsilon(1e-12));
  CHECK(once.plastic_work() == doctest::Approx(in_parts.plastic_work()).epsilon(1e-12));
  CHECK(once.stress_after(-2 * up / shear) == doctest::Approx(-up).epsilon(1e-12));  // no flow on the way back
  CHECK(once.stress_after(-0.01) == doctest::Approx(-up - 800 * 0.01).epsilon(1e-12));
}

}  // namespace heml::validation_references_test
