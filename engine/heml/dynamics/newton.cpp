#include <algorithm>
#include <heml/dynamics/line_search.hpp>
#include <heml/dynamics/newton.hpp>
#include <limits>

namespace heml {
namespace {
constexpr double switch_ratio = 0.5;  // an iteration on negative curvature that leaves more of ‖r‖ switches the remedy
// Tolerated iterations without progress: where forces are round-off; where only the potential is.
constexpr int max_idle_forces = 2, max_idle_values = 5;
// Part of the bound on the round-off of values that sums of many elements reach.
constexpr double round_off_fraction = 1e-3;
// A step that changes Φ by round-off only and leaves more of the measure asks for a more precise objective.
constexpr double slow_at_round_off = 0.5;
// Where no step lowers Φ, but one should by less than this many times its round-off, that may be why.
constexpr double near_round_off = 1e3;
// Of the residual at which a solve has converged: no linear solve needs to leave less.
constexpr double last_residual = 0.1;
constexpr double none = std::numeric_limits<double>::infinity();

/// Detects that round-off ends progress. Where a step changes Φ by round-off only, several steps together must lower Φ,
/// or the measure must fall.
class RoundOffDetector {
 public:
  /// Whether progress has ended at a point with this measure.
  bool is_over(const Objective& objective, const SearchPoint& at, double measure) {
    const bool is_lower = at.value && *at.value < lowest_ - round_off_fraction * objective.value_round_off();
    if (is_lower) {
      lowest_ = *at.value;
      best_measure_ = none;
    }
    idle_ = at.within_round_off && !is_lower && measure > 0.9 * min_measure_ ? idle_ + 1 : 0;
    min_measure_ = std::min(min_measure_, measure);
    if (at.within_round_off && measure < best_measure_) {
      best_ = at.x;
      best_measure_ = measure;
    }
    return idle_ >= max_idle_values || (idle_ >= max_idle_forces && objective.is_at_round_off(at.r));
  }
  const Vector& best() const { return best_; }
  double best_measure() const { return best_measure_; }

 private:
  double lowest_ = none;  // Φ when it last fell by more than its round-off
  double min_measure_ = none, best_measure_ = none;
  Vector best_;
  int idle_ = 0;
};
}  // namespace

NewtonResult minimise(Objective& objective, LinearSolver& linear, const StoppingCriterion& stop,
                      const NewtonOptions& options, Vector& x) {
  NewtonResult result;
  SearchPoint at{x, Vector(), std::nullopt};
  RoundOffDetector round_off;
  if (!objective.residual(at.x, at.r) || !at.r.allFinite()) return result;
  at.value = objective.value(at.x);
  Vector d;
  const bool may_project = linear.projection() != Projection::none;
  bool by_projection = may_project && (options.projects_first || linear.preconditioner() == Preconditioner::cholesky);
  const double first = at.r.norm();
  const auto finish = [&](NewtonResult::Status status) {
    x = at.x;
    if (status == NewtonResult::Status::stalled) objective.residual(x, at.r);  // leaves the objective at x
    result.status = status;
    return result;
  };
  const auto refine = [&] {
    if (!options.refines || !objective.refine_precision()) return false;
    if (!objective.residual(at.x, at.r)) at.r.setConstant(none);
    at.value = objective.value(at.x);
    at.within_round_off = false;
    round_off = {};
    return true;
  };
  double before_step = none;
  while (true) {
    if (!at.r.allFinite()) return finish(NewtonResult::Status::undefined);
    result.measure = stop.measure(at.r);
    if (result.measure <= stop.limit) return finish(NewtonResult::Status::converged);
    if (at.within_round_off && result.measure > stop.round_off_limit &&
        result.measure > slow_at_round_off * before_step && refine())
      continue;
    before_step = result.measure;
    result.at_round_off = round_off.is_over(objective, at, result.measure);
    if (result.at_round_off) {
      if (!objective.is_at_round_off(at.r) && refine()) continue;
      at.x = round_off.best();
      result.measure = round_off.best_measure();
      return finish(NewtonResult::Status::stalled);
    }
    if (result.iterations >= options.max_iterations || stop.is_interrupted())
      return finish(NewtonResult::Status::out_of_iterations);
    ++result.iterations;
    const double tolerance = std::clamp(
        std::max(options.linear_tolerance * at.r.norm() / first, last_residual * stop.limit / result.measure),
        options.min_linear_tolerance, options.linear_tolerance);
    const double before = at.r.norm();
    objective.linearise(at.x);
    const bool positive = linear.solve(objective, at.r, tolerance, d);
    if (!positive && by_projection) {
      ++result.projected;
      linear.solve_projected(objective, at.x, at.r, d);
    }
    if (line_search(objective, d, at)) {
      if (!positive && at.r.norm() > switch_ratio * before) by_projection = may_project && !by_projection;
      continue;
    }
    if (d.dot(at.r) < near_round_off * objective.value_round_off() && refine()) continue;
    if (!may_project || (!positive && by_projection)) return finish(NewtonResult::Status::stalled);
    ++result.projected;
    linear.solve_projected(objective, at.x, at.r, d);
    if (line_search(objective, d, at)) continue;
    return finish(NewtonResult::Status::stalled);
  }
}

}  // namespace heml
