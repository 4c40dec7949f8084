// Bringing back a body that was turned inside out, ran away or collapsed:
//
//   every tick ──► look: least J, number inverted, speeds ──► nothing wrong: the state is kept as the last good one
//                    │ something is, or a step had no valid end
//                    ▼
//   the last good state, or this one where there never was any; its nodes set apart by a hair
//                    ▼
//   a stable Neo-Hookean stands in (world/recovery_surrogate.hpp), one step of backward Euler a tick, damped so that
//   nothing rings, each ending no higher than it began in Φ = a/2 ‖x − y‖²_M + U
//                    │ every element upright for some steps, the body calm, and the scene's law defined
//                    ▼
//   back to the scene's law and method, positions and velocities as they are
//
// Never a reset: positions go on from step to step, held nodes keep to their motion, grasps keep their hold.
#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <heml/base/hash.hpp>
#include <heml/world/recovery_cause.hpp>
#include <heml/world/typed_world.hpp>
#include <limits>
#include <numbers>

namespace heml {
namespace {

constexpr double worst_J = -0.2;       // an element below it is not left to its law
constexpr double max_inverted = 0.01;  // of all elements
constexpr double upright_J = 0.3;      // of every element, for a recovery to end
constexpr long upright_for = 5;        // steps, if the body is calm
constexpr long upright_long = 100;     // steps, if it is not: something moves it
constexpr double calm = 0.03;          // of the speed of shear waves
constexpr double far_too_fast = 10;    // times the speed of waves and of the start: no motion of tissue
constexpr double hair = 1e-5;          // of the body's size: 1 µm for 0.1 m
constexpr std::uint64_t hair_seed = 2018;
constexpr double shrunk = 0.1;         // of its extent at rest
constexpr double caught = 0.1;         // of the speed of shear waves: what is slower and inside out is caught
constexpr long max_unfold_steps = 30;  // steps: what is inside out for longer is held so from outside
constexpr double unfolding_small = 0.01, unfolding_caught = 0.1;  // of the way home, a step
constexpr double weight_of_constrained = 1000;                    // beside free nodes, in what fits best
constexpr NewtonOptions newton_options{10, 1e-2};
constexpr double small_enough = 1e-3;     // of the first residual
constexpr double no_acceleration = 1e-2;  // m/s²

/// Least height over longest edge.
double thinness(const TetMesh& mesh, int element) {
  const Tet& tet = mesh.tets[static_cast<std::size_t>(element)];
  const auto X = [&](std::size_t c) -> const Vec3& { return mesh.nodes[static_cast<std::size_t>(tet[c % 4])]; };
  double longest = 0, largest = 0;
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (X(a) - X(b)).norm());
    largest = std::max(largest, (X(a + 1) - X(a)).cross(X(a + 2) - X(a)).norm() / 2);
  }
  return 3 * signed_volume(X(0), X(1), X(2), X(3)) / largest / longest;
}

}  // namespace

template <class Real>
void TypedWorld<Real>::start_monitoring() {
  recovery_.reset();
  if (!setup_.solver.recovery || setup_.solver.is_static()) return;
  const double max_speed = far_too_fast * (fastest_waves() + setup_.initial_velocity.norm());
  recovery_ = std::make_unique<RecoveryState<Real>>(model_.mesh, mass_, max_speed, state_);
}

/// They cross an element in about 2/ω_max. m/s.
template <class Real>
double TypedWorld<Real>::fastest_waves() const {
  return static_cast<double>(rest_frequency_) * model_.diagonal / std::cbrt(static_cast<double>(mass_.size())) / 2;
}

/// Of the stiffest material, m/s.
template <class Real>
double TypedWorld<Real>::shear_waves() const {
  double speed = 0;
  for (const RegionMaterial& entry : setup_.materials)
    speed = std::max(speed, std::sqrt(small_strain_moduli(entry.material).shear / entry.material.density));
  return speed > 0 ? speed : fastest_waves();  // a net of springs is no continuum
}

/// After a tick by the scene's own law and method, and at the start.
template <class Real>
void TypedWorld<Real>::monitor() {
  RecoveryState<Real>& parts = *recovery_;
  parts.track_tool(grasps_.empty() ? nullptr : &grasps_.front(), state_.time);
  const StateCheck seen = parts.check(model_.mesh, state_, mass_);
  const double inverted = static_cast<double>(seen.inverted) / static_cast<double>(model_.mesh.tets.size());
  if (!(seen.min_J < worst_J || inverted > max_inverted || seen.speed > parts.max_speed)) {
    parts.last_good = state_;
    parts.has_last_good = true;
  } else if (is_step_hopeless()) {
    stop({StopReason::Cause::unstable, -1, -1,
          fmt::format(
              "unstable at t = {:.6g} s: steps of {:.3g} s are too long for this body, which at rest bears {:.3g} s",
              state_.time, *setup_.solver.step, 2 / static_cast<double>(rest_frequency_))});
  } else {
    begin_recovery(seen);
  }
}

/// Whether an explicit method is told to take steps, or would need some so small, that it cannot go on even at rest.
template <class Real>
bool TypedWorld<Real>::is_step_hopeless() const {
  const double limit_at_rest = 2 / static_cast<double>(rest_frequency_);
  return is_explicit(setup_.solver.integrator) && !(limit_at_rest > setup_.solver.step.value_or(min_step));
}

/// Whether a recovery takes over from what would halt the world: not from what would fail again on a body in good
/// shape.
template <class Real>
bool TypedWorld<Real>::can_recover(const StopReason& halt) {
  if (!recovery_ || recovering() || is_step_hopeless()) return false;
  return halt.cause != StopReason::Cause::not_converged ||
         recovery_->check(model_.mesh, state_, mass_).min_J < upright_J;
}

/// seen: of the state that is given up.
template <class Real>
void TypedWorld<Real>::begin_recovery(const StateCheck& seen) {
  RecoveryState<Real>& parts = *recovery_;
  FailureDiagnosis suspects = diagnose(seen);
  Recovery report;
  report.tick = ticks_;
  report.element = suspects.element;
  report.inverted = seen.inverted;
  report.min_J = seen.min_J;
  report.message = describe_cause(suspects);
  state_.x = parts.last_good.x;
  state_.v = parts.last_good.v;
  state_.time = parts.last_good.time;
  if (remembers_) body_.begin_step(0);
  report.begun.time = state_.time;
  report.begun.before = energies();
  if (body_.first_undefined(state_.x.data()) >= 0)
    report.begun.before.elastic = std::numeric_limits<double>::quiet_NaN();
  set_apart();
  install_surrogate();
  evaluate_forces();
  report.begun.after = energies();
  parts.last = report;
  parts.upright_steps = parts.unfold_steps = 0;
  parts.unfolding = false;
  ++parts.count;
}

template <class Real>
FailureDiagnosis TypedWorld<Real>::diagnose(const StateCheck& seen) const {
  FailureDiagnosis s;
  s.time = state_.time;
  s.min_J = seen.min_J;
  s.inverted = seen.inverted;
  s.from_start = !recovery_->has_last_good;
  s.tool_speed = recovery_->tool_speed;
  s.pulled = !grasps_.empty();
  s.wave_speed = shear_waves();
  s.thinness = thinness(model_.mesh, seen.worst);
  if (setup_.solver.step && is_explicit(setup_.solver.integrator)) {
    s.step = *setup_.solver.step;
    s.limit = stable_step_;
  }
  if (seen.min_J >= upright_J && seen.speed > recovery_->max_speed) return s;
  s.element = model_.order.file_tet[static_cast<std::size_t>(seen.worst)];
  const int material = model_.material_of[static_cast<std::size_t>(seen.worst)];
  const SmallStrainModuli rest = small_strain_moduli(setup_.materials[static_cast<std::size_t>(material)].material);
  if (rest.shear > 0) s.stiffness_ratio = rest.bulk / rest.shear;
  return s;
}

template <class Real>
void TypedWorld<Real>::install_surrogate() {
  recovery_->surrogate =
      std::make_unique<RecoverySurrogate<Real>>(model_, setup_, mass_, inverse_mass_, grasps_, contacts_, team_);
}

/// At exact coincidence all forces are zero.
template <class Real>
void TypedWorld<Real>::set_apart() {
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    if (!(inverse_mass_[n] > 0)) continue;
    std::uint64_t random = hash_combine(hair_seed, static_cast<std::uint64_t>(model_.order.file_node[n]));
    for (std::size_t i = 0; i < 3; ++i) {
      random = hash_combine(random, std::uint64_t{i});
      const double part = static_cast<double>(random >> 11) * 0x1p-52 - 1;
      state_.x[3 * n + i] += static_cast<Real>(hair * model_.diagonal * part);
    }
  }
}

template <class Real>
void TypedWorld<Real>::recover(double until) {
  step_surrogate(until);
  RecoveryState<Real>& parts = *recovery_;
  const StateCheck seen = parts.check(model_.mesh, state_, mass_);
  parts.upright_steps = seen.min_J > upright_J ? parts.upright_steps + 1 : 0;
  const bool is_calm = seen.speed <= calm * shear_waves();
  if (parts.upright_steps >= (is_calm ? upright_for : upright_long)) end_recovery();
}

/// One step, whatever Newton's method reaches: Φ does not rise.
template <class Real>
void TypedWorld<Real>::step_surrogate(double until) {
  ImplicitState<Real>& parts = recovery_->surrogate->parts;
  // A body too small for its forces to tell it how to grow, or caught in a tangle of lowest energy, gets a hand.
  const StateCheck seen = recovery_->check(model_.mesh, state_, mass_);
  if (seen.extent < shrunk) unfold(unfolding_small);
  if (seen.inverted == 0)
    recovery_->unfolding = false;
  else if (recovery_->last->steps > 0 && seen.speed <= caught * shear_waves())
    recovery_->unfolding = true;
  if (recovery_->unfolding && recovery_->unfold_steps < max_unfold_steps) {
    unfold(unfolding_caught);
    ++recovery_->unfold_steps;
  }
  const double h = until - state_.time;
  parts.x = as_vector(state_.x);
  parts.v = as_vector(state_.v);
  const Stage stage = backward_euler_stage(parts.x, parts.v, h);
  // Critical for the slowest mode, which is about a wave to and fro.
  const double damping = std::max(setup_.solver.damping, 2 * std::numbers::pi * shear_waves() / model_.diagonal);
  parts.body.begin_step(parts.x, state_.time);
  parts.body.set_time(until, setup_.gravity);
  parts.body.set_velocity(stage.d, stage.x_bar);
  parts.step.set(stage.a(damping), stage.y(damping));
  parts.linear.set_inertia(stage.a(damping));
  Vector stay = parts.x, fly = (parts.mass.array() > 0).select(stage.y(damping), stay);
  for (const ConstrainedNode& constrained : model_.constrained)
    stay.segment<3>(3 * constrained.node) = fly.segment<3>(3 * constrained.node) =
        prescribed_at(model_, constrained, until).x;
  const auto staying = parts.step.value(stay), flying = parts.step.value(fly);
  Vector x = flying && *flying < *staying ? fly : stay, r;
  parts.step.residual(x, r);
  const double first = r.norm();
  const StoppingCriterion stop{
      [&](const Vector& left) {
        const auto push = (parts.mass.array() > 0).select(left.array() / parts.mass.array(), 0);
        return std::min(push.abs().maxCoeff() / no_acceleration, left.norm() / (small_enough * first));
      },
      1};
  work_.iterations += minimise(parts.step, parts.linear, stop, newton_options, x).iterations;
  parts.step.residual(x, r);  // whose forces are kept
  parts.body.end_step(x);
  set_state(x, stage.velocity(x), until);
  move_constrained();
  ++steps_;
  ++substeps_;
  ++recovery_->last->steps;
}

/// Moves free nodes a part of the way to the rest shape, placed and turned as fits the held nodes best, or, where
/// there are too few, the body.
template <class Real>
void TypedWorld<Real>::unfold(double part) {
  Vec3 x_mean = Vec3::Zero(), X_mean = Vec3::Zero();
  double mass = 0;
  const auto x = [&](std::size_t n) { return Eigen::Map<Vector3<Real>>(&state_.x[3 * n]); };
  const auto& X = model_.mesh.nodes;
  const auto weight = [&](std::size_t n) {
    return static_cast<double>(mass_[n]) * (inverse_mass_[n] > 0 ? 1 : weight_of_constrained);
  };
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    const double m = weight(n);
    x_mean += m * x(n).template cast<double>();
    X_mean += m * X[n];
    mass += m;
  }
  x_mean /= mass;
  X_mean /= mass;
  Mat3 moment = Mat3::Zero();
  for (std::size_t n = 0; n < mass_.size(); ++n)
    moment += weight(n) * (x(n).template cast<double>() - x_mean) * (X[n] - X_mean).transpose();
  const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Mat3 R = svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  for (std::size_t n = 0; n < mass_.size(); ++n) {
    if (!(inverse_mass_[n] > 0)) continue;
    const Vec3 displacement = x_mean + R * (X[n] - X_mean) - x(n).template cast<double>();
    x(n) += (part * displacement).template cast<Real>();
  }
}

/// Unless the scene's own law is not defined where the body is: then the recovery goes on.
template <class Real>
void TypedWorld<Real>::end_recovery() {
  RecoveryState<Real>& parts = *recovery_;
  if (body_.first_undefined(state_.x.data()) >= 0) return;
  LawSwitch back{state_.time, energies(), {}};
  parts.surrogate.reset();
  if (remembers_) {  // for materials that remember, all of it was one step
    body_.begin_step(static_cast<Real>(state_.time - parts.last->begun.time));
    body_.commit(state_.x.data());
    body_.begin_step(0);
  }
  if (implicit_) implicit_->h_before = 0;
  evaluate_forces();
  back.after = energies();
  parts.last->ended = back;
  last_valid_ = parts.last_good = state_;
  find_stable_step();
  method_ = choose_method();
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
