#pragma once
// What a body that is slower than real time can be cured with: another method, rate or budget.
#include <heml/scenario/suitable_method.hpp>
#include <heml/session/frame.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

/// A change of method that brings a slow body to real time, or nearer to it.
struct Cure {
  SuitableMethod method;
  std::string button;  ///< "Use backward Euler at 60 Hz: real time"
  std::string cost;    ///< what it costs in error
  std::vector<Command> commands() const;
};

/// Explicit methods and `auto`: backward Euler by the model of cost. Implicit ones: fewer iterations or a lower rate,
/// by the measured time of a tick. None where nothing is left to change.
std::optional<Cure> cure_for(const Frame& frame, Integrator integrator, int budget);

}  // namespace heml::panel
