#include <fmt/format.h>

#include <app/panel/slow_body.hpp>
#include <cmath>

namespace heml::panel {
namespace {

constexpr double wobble = 2;     // Hz, of the oscillation whose loss is told: an organ's
constexpr double slowest = 1.1;  // load up to which a body is said to be in real time

/// Of fewer iterations at the same rate.
constexpr const char* fewer_iterations_cost =
    "Costs accuracy in motion: what a step leaves unsolved is solved by the next ones, so the tissue follows more "
    "slowly. Positions at rest stay the same.";

std::string cost_text(double rate) {
  return fmt::format(
      "Costs accuracy in motion: a {:.0f} Hz wobble loses {:.0f} % of its amplitude a period to the integration. "
      "Positions at rest stay the same.",
      wobble, 100 * lost_in_a_period(wobble, rate));
}

}  // namespace

std::vector<Command> Cure::commands() const {
  return {SetIntegrator{method.integrator}, SetRate{method.rate}, SetBudget{method.budget->iterations}};
}

std::optional<Cure> cure_for(const Frame& frame, Integrator integrator, int budget) {
  const std::size_t tets = frame.elements - frame.removed;
  const bool implicit = is_implicit(integrator);
  Cure cure;
  if (implicit && budget > 0 && frame.pace.p50 > 0) {
    const double stages = info_of(integrator).stages;
    cure.method = suitable_implicit_method(frame.pace.p50 / (stages * budget));
    const bool helps = cure.method.rate < frame.pace.rate * (1 - 1e-9) || cure.method.budget->iterations < budget;
    if (!helps && integrator == Integrator::backward_euler) return std::nullopt;
  } else {
    cure.method = suitable_implicit_method(seconds_per_iteration(tets));
  }
  const std::string pace = cure.method.load <= slowest ? std::string("real time")
                                                       : fmt::format("{:.1f}× slower than real time", cure.method.load);
  const bool same_steps =
      integrator == cure.method.integrator && std::abs(cure.method.rate - frame.pace.rate) < 1e-9 * frame.pace.rate;
  const int iterations = cure.method.budget->iterations;
  cure.button = same_steps ? fmt::format("Use {} iteration{} a step: {}", iterations, iterations == 1 ? "" : "s", pace)
                           : fmt::format("Use backward Euler at {:.3g} Hz: {}", cure.method.rate, pace);
  cure.cost = same_steps ? fewer_iterations_cost : cost_text(cure.method.rate);
  return cure;
}

}  // namespace heml::panel
