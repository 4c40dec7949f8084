#include <fmt/format.h>

#include <app/panel/slow_body.hpp>

namespace heml::panel {
namespace {

constexpr double wobble = 2;     // Hz, of the oscillation whose loss is told: an organ's
constexpr double slowest = 1.1;  // load up to which a body is said to be in real time

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
  cure.button = fmt::format("Use backward Euler at {:.3g} Hz: {}", cure.method.rate, pace);
  cure.cost = cost_text(cure.method.rate);
  return cure;
}

}  // namespace heml::panel
