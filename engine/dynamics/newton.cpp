#include <algorithm>
#include <cmath>
#include <heml/dynamics/newton.hpp>

namespace heml {
namespace {

constexpr double armijo = 1e-4;
constexpr int most_cuts = 24;
constexpr double slow = 0.5;  // of ‖r‖ left by an iteration without positive curvature: the other remedy is tried next
constexpr double flatter = 0.95;  // of the slope at the start: a step at round-off must make it at least this flat

/// Where the search stands.
struct Point {
  Vector x, r;
  std::optional<double> value;
};

/// Steps along d, halved until one is good enough. Returns false and leaves `at` as it is when none is.
bool search_line(Objective& objective, const Vector& d, Point& at) {
  const double slope = d.dot(at.r);  // −dΦ/ds
  if (!(slope > 0) && at.value) return false;
  Point trial;
  double s = 1;
  for (int cut = 0; cut <= most_cuts; ++cut, s /= 2) {
    trial.x = at.x + s * d;
    if (!objective.residual(trial.x, trial.r) || !trial.r.allFinite()) continue;
    const double slope_there = d.dot(trial.r);
    const bool is_flatter = std::abs(slope_there) <= flatter * slope;
    if (!at.value) {
      if (!is_flatter && !(trial.r.norm() <= (1 - armijo * s) * at.r.norm())) continue;
    } else {
      trial.value = objective.value(trial.x);
      const double noise = objective.value_noise() + 1e-15 * std::abs(*at.value);
      if (!(*trial.value <= *at.value - armijo * s * slope + noise)) continue;
      if (s * slope < 8 * noise && !is_flatter) continue;  // values cannot tell
    }
    std::swap(at, trial);
    return true;
  }
  return false;
}

}  // namespace

NewtonResult minimise(Objective& objective, LinearSolver& linear, const Stop& stop, const NewtonOptions& options,
                      Vector& x) {
  NewtonResult result;
  Point at{x, Vector(), std::nullopt};
  if (!objective.residual(at.x, at.r) || !at.r.allFinite()) return result;
  at.value = objective.value(at.x);
  Vector d;
  bool by_elements = linear.preconditioner() == Preconditioner::cholesky;
  const double first = at.r.norm();
  const auto finish = [&](NewtonResult::End end) {
    x = at.x;
    if (end == NewtonResult::End::stalled) objective.residual(x, at.r);  // what it saw last is where it stays
    result.end = end;
    return result;
  };
  while (true) {
    result.measure = stop.measure(at.r);
    if (result.measure <= stop.limit) return finish(NewtonResult::End::converged);
    if (result.iterations >= options.most_iterations) return finish(NewtonResult::End::out_of_iterations);
    ++result.iterations;
    const double tolerance =
        std::clamp(options.linear_tolerance * at.r.norm() / first, options.tightest_linear, options.linear_tolerance);
    const double before = at.r.norm();
    objective.linearise(at.x);
    const bool positive = linear.solve(objective, at.r, tolerance, d);
    if (!positive && by_elements) {
      ++result.projected;
      linear.solve_projected(objective, at.r, d);
    }
    if (search_line(objective, d, at)) {
      if (!positive && at.r.norm() > slow * before) by_elements = !by_elements;
      continue;
    }
    if (!positive && by_elements) return finish(NewtonResult::End::stalled);
    ++result.projected;
    linear.solve_projected(objective, at.r, d);
    if (search_line(objective, d, at)) continue;
    return finish(NewtonResult::End::stalled);
  }
}

}  // namespace heml
