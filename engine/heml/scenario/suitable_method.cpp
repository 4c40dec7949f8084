#include <algorithm>
#include <cmath>
#include <heml/scenario/suitable_method.hpp>
#include <numbers>

namespace heml {
namespace {

constexpr double explicit_enough = 0.35;                // of real time
constexpr double explicit_rates[] = {1000, 500, 250};  // Hz; lower ones where ticks would be shorter than stable steps
constexpr double stable_part = 0.8;                    // of the stable step that tools and motion leave
constexpr double implicit_enough = 0.7;                // of real time
constexpr double rates[] = {60, 30, 20, 15, 10};
constexpr int max_iterations = 4;  // a stage: at 60 Hz more change nothing that is seen
constexpr int linear_iterations = 20;
// s a tetrahedron and Newton iteration of at most linear_iterations, one core: tests/bench/organ.py. Solves of longer
// steps take more iterations, up to the bound.
constexpr double seconds_per_tet = 2e-6, seconds_per_quadratic_tet = 7.8e-6;

}  // namespace

std::span<const double> implicit_rates() { return rates; }

SuitableMethod suitable_implicit_method(double seconds_per_iteration) {
  SuitableMethod method;
  method.integrator = Integrator::backward_euler;
  const double room = implicit_enough / seconds_per_iteration;  // iterations a second
  const auto fits = std::find_if(std::begin(rates), std::end(rates), [&](double rate) { return rate <= room; });
  method.rate = fits == std::end(rates) ? std::end(rates)[-1] : *fits;
  method.budget.emplace();
  method.budget->iterations = static_cast<int>(std::clamp<double>(room / method.rate, 1, max_iterations));
  method.budget->linear = linear_iterations;
  method.load = method.rate * method.budget->iterations * seconds_per_iteration;
  return method;
}

double seconds_per_iteration(std::size_t tets, bool quadratic) {
  return (quadratic ? seconds_per_quadratic_tet : seconds_per_tet) * static_cast<double>(tets);
}

bool affords_quadratic(std::size_t tets) { return seconds_per_iteration(tets, true) * rates[0] <= implicit_enough; }

SuitableMethod suitable_method(std::size_t tets, const ExplicitCost& cost, bool quadratic) {
  for (const double rate : explicit_rates) {
    const double load = rate * std::ceil(1 / (rate * stable_part * cost.stable)) * cost.seconds;
    if (load <= explicit_enough) return {Integrator::verlet, rate, {}, load};
  }
  return suitable_implicit_method(seconds_per_iteration(tets, quadratic));
}

double usual_rate(Integrator integrator) { return is_implicit(integrator) ? rates[0] : SolverSettings{}.rate; }

double lost_in_a_period(double frequency, double rate) {
  const double turn = 2 * std::numbers::pi * frequency / rate;
  return 1 - std::pow(1 + turn * turn, -rate / frequency / 2);
}

void adopt(const SuitableMethod& method, SolverSettings& solver) {
  solver.integrator = method.integrator;
  solver.step.reset();
  solver.rate = method.rate;
  solver.budget = method.budget;
}

}  // namespace heml
