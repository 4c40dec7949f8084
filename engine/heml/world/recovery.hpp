#pragma once
// What a world says of a body that it brought back, or is bringing back, from where the scene's own law and method
// could not go on. How it does so is in recovery_steps.cpp.
#include <optional>
#include <string>

namespace heml {

/// J.
struct Energies {
  double kinetic = 0;
  double elastic = 0;
  double potential = 0;  ///< of gravity, 0 at the rest shape
};

/// Energies of one state either side of a switch from one law to another. NaN where a law has no energy there.
struct LawSwitch {
  double time = 0;  ///< s
  Energies before, after;
};

struct Recovery {
  long tick = 0;                   ///< whole ticks done when it began
  LawSwitch begun;                 ///< from the scene's law to the stand-in
  std::optional<LawSwitch> ended;  ///< and back; none: it goes on
  long steps = 0;                  ///< of the stand-in so far
  int element = -1;                ///< the first bad element, mesh-file order; -1: none to name
  int inverted = 0;                ///< elements with J ≤ 0 where it began
  double min_J = 0;                ///< there
  std::string message;             ///< one sentence for people: what went wrong, why most likely, what to do about it
};

}  // namespace heml
