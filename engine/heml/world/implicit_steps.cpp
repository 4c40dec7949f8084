// Steps of the implicit methods: each is one or two stages (dynamics/implicit_stage.hpp), each stage one minimisation.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/dynamics/lbfgs.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {
constexpr double min_share = 1.0 / 64;    // of a tick: shorter steps are not tried
constexpr double slack_of_motion = 1e-3;  // of gravity's acceleration: what a step may leave unbalanced
constexpr double earth = 9.81;            // m/s²
constexpr int max_probe_substeps = 64;    // of a probe in a step
constexpr int quasi_patience = 5;         // iterations of L-BFGS for one of Newton's: then Newton's go on
}  // namespace

template <class Real>
ImplicitState<Real>& TypedWorld<Real>::implicit() {
  if (!implicit_)
    implicit_ = std::make_unique<ImplicitState<Real>>(
        body_, model_, mass_, inverse_mass_,
        preconditioner_moduli(model_.mesh, model_.material_of, setup_.materials, setup_.solver.minimiser), grasps_,
        contacts_, team_, setup_.solver);
  return *implicit_;
}

/// A given step is obeyed; without one, a tick is halved where its step does not converge.
template <class Real>
void TypedWorld<Real>::advance_implicit(double until) {
  const double whole = until - state_.time;
  double longest = whole;
  while (state_.time < until && !halt_ && !recovering() && !interrupted_) {
    const bool last = state_.time + 1.5 * longest > until;
    const double after = last ? until : state_.time + longest;
    if (implicit_step(after - state_.time, after)) {
      ++substeps_;
      continue;
    }
    longest /= 2;
    if (setup_.solver.step || longest < min_share * whole)
      halt_unsolved(undefined_at_.empty() ? StopReason{StopReason::Cause::not_converged, -1, -1, why_unbalanced()}
                                          : out_of_range(undefined_at_, after));
  }
}

template <class Real>
std::string TypedWorld<Real>::why_unbalanced() const {
  return fmt::format("did not converge at t = {:.6g} s: {} (take a smaller step{})", state_.time,
                     std::isfinite(work_.residual)
                         ? fmt::format("{:.3g} of the forces is left unbalanced", work_.residual)
                         : "the forces left unbalanced overflow",
                     setup_.solver.tolerance ? " or a larger tolerance" : "");
}

template <class Real>
void TypedWorld<Real>::halt_unsolved(const StopReason& halt) {
  if (remembers_) body_.begin_step(0);
  evaluate_forces();
  stop(halt);
}

template <class Real>
bool TypedWorld<Real>::implicit_step(double h, double time_after) {
  ImplicitState<Real>& parts = implicit();
  parts.x = as_vector(state_.x);
  parts.v = as_vector(state_.v);
  Vector x = parts.x, v = parts.v;
  parts.body.begin_step(parts.x, state_.time);
  bool done = false;
  if (method_ == Integrator::backward_euler) {
    done = solve_stage(backward_euler_stage(x, v, h), h, time_after, x, v);
  } else if (method_ == Integrator::bdf2 && parts.h_before > 0) {
    done = solve_stage(bdf2_stage(x, v, parts.x_before, parts.v_before, h, parts.h_before), h, time_after, x, v);
  } else {
    const Vector f = as_vector(state_.f);
    const Vector push = (parts.mass.array() > 0).select(f.array() / parts.mass.array(), 0);
    const Stage first = tr_bdf2::first_stage(x, v, push - setup_.solver.damping * v, h);
    const double middle = tr_bdf2::gamma * h;
    done = solve_stage(first, middle, state_.time + middle, x, v) &&
           solve_stage(tr_bdf2::second_stage(parts.x, parts.v, x, v, h), h, time_after, x, v);
  }
  if (!done) {
    if (remembers_) body_.begin_step(0);
    return false;
  }
  if (setup_.solver.budget) limit_energy(h, time_after, x, v);
  parts.body.end_step(x);
  parts.x_before = parts.x;
  parts.v_before = parts.v;
  parts.h_before = h;
  set_state(x, v, time_after);
  if (remembers_) {
    body_.commit(state_.x.data());
    body_.begin_step(0);
  }
  ++steps_;
  return true;
}

template <class Real>
Vector TypedWorld<Real>::as_vector(const std::vector<Real>& values) {
  return Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, 1>>(values.data(),
                                                                  static_cast<Eigen::Index>(values.size()))
      .template cast<double>();
}

/// Keeps what a solve has reached; forces are those the objective saw last.
template <class Real>
void TypedWorld<Real>::set_state(const Vector& x, const Vector& v, double time) {
  const Vector& f = (recovering() ? recovery_->surrogate->parts : implicit()).body.forces();
  for (std::size_t i = 0; i < state_.x.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    state_.x[i] = static_cast<Real>(x[k]);
    state_.v[i] = static_cast<Real>(v[k]);
    state_.f[i] = static_cast<Real>(f[k]);
  }
  state_.time = time;
  last_valid_ = state_;
}

/// From x (the start of the step or of the stage) to the end of a stage, in x and v. h: s since the start of the step.
template <class Real>
bool TypedWorld<Real>::solve_stage(const Stage& stage, double h, double time, Vector& x, Vector& v) {
  ImplicitState<Real>& parts = implicit();
  const double damping = setup_.solver.damping;
  if (remembers_) body_.begin_step(static_cast<Real>(h));
  parts.body.set_time(time, setup_.gravity);
  parts.body.set_velocity(stage.d, stage.x_bar);
  parts.step.set(stage.a(damping), stage.y(damping));
  parts.linear.set_inertia(stage.a(damping));
  const int substeps = probe_substeps(h);
  parts.body.move_tools(time - h * (substeps - 1) / substeps);
  x = stage_start(stage, time, x);
  NewtonResult result;
  for (int substep = 1; substep <= substeps; ++substep) {
    if (substep > 1) parts.body.move_tools(time - h * (substeps - substep) / substeps);
    do {
      result = minimise_stage(x);
      work_.iterations += result.iterations;
    } while (result.status != NewtonResult::Status::undefined && !setup_.solver.budget && parts.body.update_lagged(x));
  }
  Vector r;
  parts.step.residual(x, r);
  work_.residual = parts.body.relative_residual(r);
  undefined_at_.clear();
  if (result.status == NewtonResult::Status::undefined) {
    for (const double value : x) undefined_at_.push_back(static_cast<Real>(value));
    return false;
  }
  if (!result.converged() && !setup_.solver.budget && !is_balanced_enough(stage, r)) return false;
  v = stage.velocity(x);
  for (const ConstrainedNode& constrained : model_.constrained)
    v.segment<3>(3 * constrained.node) = prescribed_at(model_, constrained, time).v;
  for (const PinnedPatch& pin : pins_)
    for (const int n : pin.nodes) v.segment<3>(3 * n).setZero();
  return true;
}

/// Into how many parts what a probe goes in h, s, is divided: it meets tissue at the end of each, and does not pass it.
template <class Real>
int TypedWorld<Real>::probe_substeps(double h) const {
  if (!contacts_.probe) return 1;
  const double travel = (contacts_.probe->tip(state_.time + h) - contacts_.probe->tip(state_.time)).norm();
  return std::clamp(static_cast<int>(std::ceil(2 * travel / contacts_.probe->radius())), 1, max_probe_substeps);
}

template <class Real>
NewtonResult TypedWorld<Real>::minimise_stage(Vector& x) {
  ImplicitState<Real>& parts = implicit();
  const int most = setup_.solver.budget ? stage_iterations() : NewtonOptions{}.max_iterations;
  if (setup_.solver.minimiser == Minimiser::lbfgs) {
    const int patience = setup_.solver.budget ? most : quasi_patience * most;
    const NewtonResult result = minimise_lbfgs(parts.step, parts.linear, stage_criterion(), patience, x);
    if (result.converged() || setup_.solver.budget || result.status == NewtonResult::Status::undefined) return result;
  }
  NewtonOptions options;
  options.max_iterations = most;
  return minimise(parts.step, parts.linear, stage_criterion(), options, x);
}

/// Of where the body is and where it would fly: the one with the lower Φ (without this guard, methods of few iterations
/// gain energy without bound); where held nodes move so far that neither is possible, along the tangent.
template <class Real>
Vector TypedWorld<Real>::stage_start(const Stage& stage, double time, const Vector& x) {
  ImplicitState<Real>& parts = implicit();
  const auto apply_constraints = [&](Vector& to) {
    for (const ConstrainedNode& constrained : model_.constrained)
      to.segment<3>(3 * constrained.node) = prescribed_at(model_, constrained, time).x;
  };
  Vector stay = x, fly = stage.y(setup_.solver.damping), r_stay, r_fly, r;
  for (Eigen::Index i = 0; i < fly.size(); ++i)
    if (!(parts.mass[i] > 0)) fly[i] = x[i];
  apply_constraints(stay);
  apply_constraints(fly);
  const auto is_defined = [&](const Vector& at, Vector& r_there) {
    return parts.step.residual(at, r_there) && r_there.allFinite();
  };
  const auto staying = parts.step.value(stay), flying = parts.step.value(fly);
  if (staying && flying) {
    const bool flies = *flying < *staying;
    const Vector &lower = flies ? fly : stay, &higher = flies ? stay : fly;
    if (is_defined(lower, r)) return lower;
    if (is_defined(higher, r)) return higher;
  } else {
    const bool can_stay = is_defined(stay, r_stay), can_fly = is_defined(fly, r_fly);
    if (can_stay && can_fly) return r_fly.norm() < r_stay.norm() ? fly : stay;
    if (can_stay || can_fly) return can_stay ? stay : fly;
  }
  Vector stretched, d;
  if (!parts.step.residual(x, r)) return stay;
  parts.step.linearise(x);
  parts.step.product(stay - x, stretched);
  r -= stretched;
  return parts.linear.solve(parts.step, r, 1e-2, d) ? Vector(stay + d) : stay;
}

/// Contract: "tolerance".
template <class Real>
StoppingCriterion TypedWorld<Real>::stage_criterion() {
  ImplicitState<Real>& parts = implicit();
  return {[&parts](const Vector& r) { return parts.body.relative_residual(r); }, setup_.solver.relative_tolerance()};
}

/// Whether a step may end where Newton's method can do no more: a tolerance that was given decides alone; without one,
/// by what is left of acceleration, since an imbalance relative to small loads is beyond a stiff body's round-off.
template <class Real>
bool TypedWorld<Real>::is_balanced_enough(const Stage& stage, const Vector& r) {
  if (setup_.solver.tolerance) return false;
  ImplicitState<Real>& parts = implicit();
  const double noise = parts.body.acceleration_round_off() + 0x1p-52 * stage.a(setup_.solver.damping) * model_.diagonal;
  return parts.body.max_acceleration(r) <=
         std::max(slack_of_motion * std::max(setup_.gravity.norm(), earth), 10 * noise);
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
