#pragma once
// How far to go along a direction: halved until Armijo's rule holds for Φ, with slack for round-off, where the slope
// along the step decides instead (Hager & Zhang 2005, "approximate Wolfe"); where forces have no potential, by that
// slope or by ‖r‖. States where Φ is not defined are stepped back from like any other bad one.
#include <heml/dynamics/objective.hpp>

namespace heml {

/// Where a search stands.
struct SearchPoint {
  Vector x, r;  ///< positions; the residual there
  std::optional<double> value;
  bool within_round_off = false;  ///< whether the step that led here changed Φ by no more than its round-off
};

/// Steps along d. Returns false and leaves `at` as it is when no step is good enough.
bool line_search(Objective& objective, const Vector& d, SearchPoint& at);

}  // namespace heml
