#include <algorithm>
#include <heml/dynamics/line_search.hpp>
#include <heml/dynamics/newton.hpp>
#include <limits>

namespace heml {
namespace {
constexpr double slow = 0.5;  // of ‖r‖ left by an iteration without positive curvature: the other remedy is tried next
// Iterations that bring nothing, where forces are round-off, and where the potential alone is.
constexpr int patience_of_forces = 2, patience_of_values = 5;
constexpr double mostly = 1e-3;  // of the bound on round-off of values: what it comes to in sums of many elements
}  // namespace

NewtonResult minimise(Objective& objective, LinearSolver& linear, const Stop& stop, const NewtonOptions& options,
                      Vector& x) {
  NewtonResult result;
  SearchPoint at{x, Vector(), std::nullopt};
  Vector best;  // of those at round-off
  if (!objective.residual(at.x, at.r) || !at.r.allFinite()) return result;
  at.value = objective.value(at.x);
  Vector d;
  const bool may_project = linear.projection() != Projection::none;
  bool by_projection = may_project && linear.preconditioner() == Preconditioner::cholesky;
  const double first = at.r.norm();
  constexpr double none = std::numeric_limits<double>::infinity();
  double least = none, least_at_noise = none;
  double lowest = none;  // Φ when it last fell by more than its round-off
  int idle = 0;
  const auto finish = [&](NewtonResult::End end) {
    x = at.x;
    if (end == NewtonResult::End::stalled) objective.residual(x, at.r);  // what it saw last is where it stays
    result.end = end;
    return result;
  };
  while (true) {
    result.measure = stop.measure(at.r);
    if (result.measure <= stop.limit) return finish(NewtonResult::End::converged);
    // Where Φ no longer tells steps apart, several together have to lower it, or the measure has to fall, or this is as
    // near as round-off lets it come.
    const bool is_lower = at.value && *at.value < lowest - mostly * objective.value_noise();
    if (is_lower) lowest = *at.value;
    idle = at.at_noise && !is_lower && result.measure > 0.9 * least ? idle + 1 : 0;
    if (is_lower) least_at_noise = none;
    if (at.at_noise && result.measure < least_at_noise) {
      best = at.x;
      least_at_noise = result.measure;
    }
    least = std::min(least, result.measure);
    result.at_round_off = idle >= (objective.is_round_off(at.r) ? patience_of_forces : patience_of_values);
    if (result.at_round_off) {
      at.x = best;
      result.measure = least_at_noise;
      return finish(NewtonResult::End::stalled);
    }
    if (result.iterations >= options.most_iterations) return finish(NewtonResult::End::out_of_iterations);
    ++result.iterations;
    const double tolerance =
        std::clamp(options.linear_tolerance * at.r.norm() / first, options.tightest_linear, options.linear_tolerance);
    const double before = at.r.norm();
    objective.linearise(at.x);
    const bool positive = linear.solve(objective, at.r, tolerance, d);
    if (!positive && by_projection) {
      ++result.projected;
      linear.solve_projected(objective, at.x, at.r, d);
    }
    if (search_line(objective, d, at)) {
      if (!positive && at.r.norm() > slow * before) by_projection = may_project && !by_projection;
      continue;
    }
    if (!may_project || (!positive && by_projection)) return finish(NewtonResult::End::stalled);
    ++result.projected;
    linear.solve_projected(objective, at.x, at.r, d);
    if (search_line(objective, d, at)) continue;
    return finish(NewtonResult::End::stalled);
  }
}

}  // namespace heml
