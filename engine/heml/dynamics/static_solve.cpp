#include <algorithm>
#include <cmath>
#include <heml/dynamics/incremental_potential.hpp>
#include <heml/dynamics/static_solve.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double min_increment = 1.0 / 1024;       // smallest increment of Newton; below, relaxation
constexpr double relaxation_increment = 1.0 / 64;  // increment of relaxation
constexpr double min_limit_increment = 1e-7;       // smallest increment towards a limit point
constexpr int eigenvalue_iterations = 12;
constexpr double eigenvalue_tolerance = 1e-3;
// Where float fails, load_to() asks for double: Newton itself would ask earlier, and take as many iterations as double.
constexpr NewtonOptions newton_options{60, 1e-3, min_float_tolerance, false};
constexpr double round_off_factor = 100;   // times the tolerance: residual that is accepted as round-off
constexpr double parabola_part = 1.0 / 8;  // of an increment: here Φ is compared with that at its end
constexpr double max_above_parabola = 100;
constexpr double double_tolerance = 1e-8;  // of a body in float that begins again in double
constexpr int growth_iterations = 8;  // Newton iterations up to which the increment doubles
constexpr NewtonOptions relaxation_options{8, 1e-2};
constexpr int max_relaxation_steps = 80;

}  // namespace

StaticSolve::StaticSolve(LoadDependentObjective& body, LinearSolver& linear, const Vector& mass, const FreeNodes& free,
                         StaticTolerance limit, double inertia, Vector start)
    : StaticSolveMemory(std::move(start)),
      body_(body),
      linear_(linear),
      mass_(mass),
      free_(free),
      inertia_(inertia),
      stop_{[&body](const Vector& r) { return body.relative_residual(r); }, limit.tolerance,
            limit.strict ? limit.tolerance : round_off_factor * limit.tolerance},
      strict_(limit.strict) {}

bool StaticSolve::load_to(double fraction, const std::atomic<bool>& stop) {
  linear_.set_inertia(inertia_);
  if (!solved_ && fraction <= load_) return increment(load_) || (refine() && increment(load_)) || relax(load_);
  const StaticSolveMemory start = *this;
  refined_ = false;
  if (follow_path(fraction, stop)) return true;
  if (stop || !refined_) return false;
  // In float the path may have left that of double before double was asked for, at a branch.
  const long tried = iterations_;
  StaticSolveMemory::operator=(start);
  iterations_ = tried;
  refine();
  const StoppingCriterion asked = stop_;
  stop_.limit = std::min(stop_.limit, double_tolerance);
  const bool reached = follow_path(fraction, stop);
  stop_ = asked;
  return reached;
}

bool StaticSolve::refine() {
  if (!body_.refine_precision()) return false;
  refined_ = true;
  return true;
}

bool StaticSolve::follow_path(double fraction, const std::atomic<bool>& stop) {
  while (load_ < fraction) {
    if (stop) return false;
    const double next = load_ + step_ * (1 + 1e-9) >= fraction ? fraction : load_ + step_;
    if (increment(next)) {
      if (last_iterations_ <= growth_iterations) step_ *= 2;
      continue;
    }
    if (stalled_ && refine()) continue;
    if (round_off_) {  // at a smaller load, round-off is relatively larger
      if (refine()) continue;
      return false;
    }
    step_ = (next - load_) / 2;
    if (step_ >= min_increment) continue;
    if (refine()) {
      step_ = relaxation_increment;
      continue;
    }
    if (!relax(std::min(fraction, load_ + relaxation_increment))) return false;
    step_ = relaxation_increment;
  }
  return true;
}

std::optional<double> StaticSolve::approach_limit(const Vector& rest, const std::atomic<bool>& stop) {
  body_.refine_precision();
  for (double step = min_increment; step >= min_limit_increment && !stop; step /= 2)
    while (!stop && load_ + step <= 1 && increment(load_ + step)) continue;
  body_.set_load(0);
  const auto at_rest = lowest_stiffness(rest);
  body_.set_load(load_);
  const auto at_limit = lowest_stiffness(x_);
  return at_limit && at_rest ? std::optional(*at_limit / *at_rest) : std::nullopt;
}

/// The lowest eigenvalue of K at x, N/m, by inverse iteration; none if a pivot of K is not positive.
std::optional<double> StaticSolve::lowest_stiffness(const Vector& x) {
  Vector v = (mass_.array() > 0).select(Vector::LinSpaced(x.size(), 1, 2).array().sin(), 0), r, d;
  if (!body_.residual(x, r)) return std::nullopt;
  body_.linearise(x);
  for (int k = 0; k < eigenvalue_iterations; ++k) {
    v.normalize();
    if (!linear_.solve(body_, v, eigenvalue_tolerance, d)) return std::nullopt;
    v = d;
  }
  return 1 / v.norm();
}

bool StaticSolve::increment(double next) {
  Vector x = initial_guess_ = predict(next);
  stalled_ = false;
  if (next - load_ > 2 * min_increment && is_far(x)) return false;
  return solve(x) && keep(next, x);
}

/// Whether a start is so far that shorter increments cost less: with inverted elements, or with a Φ far above the
/// parabola that its growth at the beginning of the increment suggests. Newton lowers the Φ of an exponential law by a
/// factor e an iteration.
bool StaticSolve::is_far(const Vector& start) {
  Vector r;
  const auto value_at = [&](const Vector& x) {
    return body_.residual(x, r) && r.allFinite() ? body_.value(x)
                                                 : std::optional(std::numeric_limits<double>::infinity());
  };
  if (!body_.is_admissible(start)) return true;
  const auto here = value_at(x_), near = value_at(x_ + parabola_part * (start - x_)), there = value_at(start);
  if (!here || !near || !there) return false;  // no potential
  const double parabola = std::abs(*near - *here) / (parabola_part * parabola_part);
  return std::isinf(*near) || *there - *here > max_above_parabola * (parabola + std::abs(*here));
}

/// Predictor along the tangent at the present state: K Δx = change of the loads − K · (motion of constrained nodes).
Vector StaticSolve::predict(double next) {
  Vector moved = x_, r, stretched, d;
  body_.apply_constraints(next, moved);
  body_.set_load(next);
  const Vector motion = moved - x_;
  if (!body_.residual(x_, r)) return moved;
  body_.linearise(x_);
  body_.product(motion, stretched);
  r -= stretched;
  if (r.norm() == 0 || !linear_.solve(body_, r, newton_options.linear_tolerance, d)) return moved;
  const Vector predicted = moved + d;
  Vector unused;
  if (!body_.residual(predicted, unused) || !unused.allFinite()) return moved;
  if (!body_.residual(moved, unused) || !unused.allFinite()) return predicted;
  const auto with = body_.value(predicted), without = body_.value(moved);
  return with && !(*with < *without) ? moved : predicted;
}

bool StaticSolve::solve(Vector& x) {
  last_iterations_ = 0;
  do {
    NewtonResult newton = minimise(body_, linear_, stop_, newton_options, x);
    if (newton.at_round_off && newton.measure > stop_.limit && refine()) {
      iterations_ += newton.iterations;
      newton = minimise(body_, linear_, stop_, newton_options, x);
    }
    iterations_ += newton.iterations;
    stalled_ = newton.status == NewtonResult::Status::stalled;
    last_iterations_ = std::max(last_iterations_, newton.iterations);
    if (!is_converged(newton, x)) return false;
  } while (body_.update_lagged(x));
  return true;
}

/// Whether Newton converged, or was stopped by round-off near enough to the tolerance, unless strict.
bool StaticSolve::is_converged(const NewtonResult& newton, const Vector& x) {
  round_off_.reset();
  Vector r;
  if (!newton.at_round_off || !body_.residual(x, r) || !body_.is_at_round_off(r)) return newton.converged();
  if (!strict_ && newton.measure <= stop_.round_off_limit) return true;
  round_off_ = newton.measure;
  return false;
}

bool StaticSolve::keep(double next, const Vector& x) {
  if (!body_.is_admissible(x)) return false;
  Vector r;
  body_.residual(x, r);
  relative_residual_ = body_.relative_residual(r);
  x_ = x;
  load_ = next;
  solved_ = true;
  ++increments_;
  body_.accept(x_);
  return true;
}

bool StaticSolve::relax(double next) {
  Vector x = initial_guess_ = predict(next), r, Kr;
  if (!body_.residual(x, r)) return false;
  if (r.norm() == 0) return solve(x) && keep(next, x);
  // Inertia starts by matching the stiffness along the residual and then falls.
  const Vector push = (mass_.array() > 0).select(r.array() / mass_.array(), 0);
  body_.linearise(x);
  body_.product(push, Kr);
  double a = std::abs(push.dot(Kr)) / push.dot(r);
  IncrementalPotential inert(body_, mass_, free_);
  bool reached = false;
  for (int k = 0; k < max_relaxation_steps && !reached && std::isfinite(a) && a > 0; ++k) {
    inert.set(a, x);
    linear_.set_inertia(a);
    const NewtonResult newton = minimise(inert, linear_, stop_, relaxation_options, x);
    iterations_ += newton.iterations;
    body_.residual(x, r);
    reached = body_.relative_residual(r) <= stop_.limit && !body_.update_lagged(x);
    a *= newton.status == NewtonResult::Status::converged ? 1.0 / 8
         : newton.status == NewtonResult::Status::stalled ? 16
                                                          : 1.0 / 2;
  }
  linear_.set_inertia(inertia_);
  return reached && keep(next, x);
}

}  // namespace heml
