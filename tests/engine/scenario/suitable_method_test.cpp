#include <doctest/doctest.h>

#include <cmath>
#include <heml/scenario/suitable_method.hpp>
#include <numbers>

namespace heml::suitable_method_test {

constexpr ExplicitCost slow{1e-3, 1e-6};

TEST_CASE("explicit steps where they are fast enough, however many tetrahedra there are") {
  const SuitableMethod method = suitable_method(1000000, {1e-4, 1e-2});
  CHECK(method.integrator == Integrator::verlet);
  CHECK(method.rate == 1000);
  CHECK_FALSE(method.budget);
  CHECK(method.load == doctest::Approx(0.1));
}

TEST_CASE("explicit ticks are no shorter than their steps need to be") {
  CHECK(suitable_method(30000, {6e-4, 3e-3}).rate == 500);
  CHECK(suitable_method(30000, {1.2e-3, 6e-3}).rate == 250);
  CHECK(suitable_method(30000, {1e-3, 1e-3}).integrator == Integrator::backward_euler);
}

TEST_CASE("else the highest rate of backward Euler that is in real time, and 10 Hz where none is") {
  double before = 1e9;
  for (const std::size_t tets : {100, 1000, 4000, 8000, 12000, 20000, 35000, 1000000}) {
    CAPTURE(tets);
    const SuitableMethod method = suitable_method(tets, slow);
    CHECK(method.integrator == Integrator::backward_euler);
    REQUIRE(method.budget);
    CHECK(method.budget->iterations >= 1);
    CHECK(method.budget->linear > 0);
    CHECK(method.rate <= before);
    before = method.rate;
    CHECK((method.load <= 0.7 || (method.rate == 10 && method.budget->iterations == 1)));
  }
  CHECK(suitable_method(1000, slow).rate == 60);
  CHECK(suitable_method(10000, slow).rate < 60);
  CHECK(suitable_method(10000, slow).rate >= 20);
  CHECK(suitable_method(1000000, slow).load > 1);
}

TEST_CASE("the method becomes the solver's, and a given step goes") {
  SolverSettings solver;
  solver.step = 0.001;
  adopt(suitable_method(4000, slow), solver);
  CHECK_FALSE(solver.step);
  CHECK(solver.integrator == Integrator::backward_euler);
  CHECK(solver.tick() == doctest::Approx(1.0 / 60));
  CHECK(solver.budget->iterations >= 1);
}

TEST_CASE("what backward Euler takes from an oscillation in a period") {
  // x'' = −ω² x by backward Euler: the amplitude (x² + (v/ω)²)^½ shrinks by (1 + (ωh)²)^½ a step.
  const double frequency = 2, rate = 60, h = 1 / rate, omega = 2 * std::numbers::pi * frequency;
  double x = 1, v = 0;
  for (int k = 0; k < 30; ++k) {  // one period
    v = (v - h * omega * omega * x) / (1 + h * h * omega * omega);
    x += h * v;
  }
  const double amplitude = std::sqrt(x * x + v * v / (omega * omega));
  CHECK(lost_in_a_period(frequency, rate) == doctest::Approx(1 - amplitude).epsilon(1e-12));
  CHECK(lost_in_a_period(frequency, 10) > lost_in_a_period(frequency, 30));
}

TEST_CASE("the usual rates of explicit and implicit methods") {
  CHECK(usual_rate(Integrator::verlet) == 1000);
  for (const Integrator integrator : implicit_integrators()) CHECK(usual_rate(integrator) == 60);
}

}  // namespace heml::suitable_method_test
