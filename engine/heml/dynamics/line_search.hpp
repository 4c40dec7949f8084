#pragma once
// Backtracking line search: halves the step until Φ satisfies Armijo's rule. If the decrease is within round-off, the
// slope along the step decides instead (Hager & Zhang 2005, "approximate Wolfe"). If the forces have no potential, that
// slope or ‖r‖ decides. Steps to states where Φ is undefined are rejected, and long steps that invert elements are
// skipped at first.
#include <heml/dynamics/objective.hpp>

namespace heml {

/// A point of a search.
struct SearchPoint {
  Vector x, r;  ///< 3 #V: positions, m; residual, N
  std::optional<double> value;
  bool within_round_off = false;  ///< whether the step that led here changed Φ by no more than its round-off
};

/// Moves `at` along d. Returns false and leaves `at` unchanged if no step is accepted.
bool line_search(Objective& objective, const Vector& d, SearchPoint& at);

}  // namespace heml
