#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/dynamics/integrator_list.hpp>
#include <heml/dynamics/lbfgs.hpp>
#include <heml/world/energy_limit.hpp>
#include <heml/world/failure.hpp>
#include <heml/world/implicit_stepper.hpp>
#include <heml/world/stage_start.hpp>
#include <limits>
#include <utility>

namespace heml {
namespace {
constexpr double min_share = 1.0 / 64;       // of a tick: shorter steps are not tried
constexpr double slack_of_motion = 1e-3;     // of gravity's acceleration: what a step may leave unbalanced
constexpr double earth = 9.81;               // m/s²
constexpr int max_probe_substeps = 64;       // of a probe in a step
constexpr double round_off_fraction = 1e-2;  // of the bound on the round-off of energies: what sums of elements reach
constexpr double resolved = 4;               // (ω h)² of motions that a step of h can follow
constexpr int quasi_patience = 5;            // iterations of L-BFGS for one of Newton's: then Newton's go on

// Of an iteration, a tetrahedron, one core: the stiffness, a dozen products and back-solves, two forces and values. For
// budgets in milliseconds where no clock may be asked; a session measures (session/budget_controller.hpp).
constexpr double seconds_an_iteration = 0.7e-6;
constexpr int max_iterations = 60;
constexpr double rough_limit = 1e-3;         // of a stage's residual, while contact still changes with each solve
constexpr long max_failed_iterations = 120;  // in contact: of a tick's attempts that fail, of a stage's solves
}  // namespace

template <class Real>
std::optional<StopReason> ImplicitStepper<Real>::advance(double until) {
  const double whole = until - s_.state.time;
  const double shortest = s_.ticks <= s_.explicit_until ? whole : min_share * whole;
  double longest = whole;
  long failed_iterations = 0;
  while (s_.state.time < until && !s_.interrupted) {
    const bool last = s_.state.time + 1.5 * longest > until;
    const double after = last ? until : s_.state.time + longest;
    const long iterations_before = s_.stats.iterations;
    const double h = after - s_.state.time;
    const Integrator method = is_noisy(h, after) ? Integrator::backward_euler : s_.method;
    if (step(method, h, after) || lagging_step(h, after) || damped_step(h, after)) {
      if (method != s_.method) ++s_.stats.damped_steps;
      ++s_.substeps;
      continue;
    }
    if (s_.interrupted) break;
    longest /= 2;
    failed_iterations += s_.stats.iterations - iterations_before;
    // Pairs in contact are fixed during a solve: where they do not fit, shorter steps fail as well, at the same cost.
    const bool is_hopeless = !s_.contacts.empty() && failed_iterations > max_failed_iterations;
    if (s_.setup->solver.step || longest < shortest || is_hopeless)
      return keep_last_solved(s_, undefined_at_.empty()
                                      ? StopReason{StopReason::Cause::not_converged, -1, -1, why_unbalanced()}
                                      : out_of_range(s_, undefined_at_, after));
  }
  return std::nullopt;
}

template <class Real>
std::string ImplicitStepper<Real>::why_unbalanced() const {
  return fmt::format("did not converge at t = {:.6g} s: {} (take a smaller step{})", s_.state.time,
                     std::isfinite(s_.stats.residual)
                         ? fmt::format("{:.3g} of the forces is left unbalanced", s_.stats.residual)
                         : "the forces left unbalanced overflow",
                     s_.setup->solver.tolerance ? " or a larger tolerance" : "");
}

/// Solves the stages of a step for a method of IntegratorList.
template <class Real>
class ImplicitStepper<Real>::StagedStep final : public ImplicitStep {
 public:
  StagedStep(ImplicitStepper& stepper, double length, double time_after)
      : stepper_(stepper), start_(stepper.s_.state.time), end_(time_after) {
    const ImplicitState<Real>& parts = *stepper.s_.implicit;
    h = length;
    x = parts.x;
    v = parts.v;
    x_start = &parts.x;
    v_start = &parts.v;
    x_before = &parts.x_before;
    v_before = &parts.v_before;
    h_before = parts.h_before;
  }
  bool solve(const Stage& stage, double h_end) override {
    return stepper_.solve_stage(stage, h_end, h_end == h ? end_ : start_ + h_end, x, v);
  }
  /// That of all forces; under a budget, less what the last solve left unbalanced, which would throw stiff elements
  /// (after Hosea & Shampine 1996, who take the derivative that the last stage ended with).
  Vector acceleration() const override {
    const Simulation<Real>& s = stepper_.s_;
    const ImplicitState<Real>& parts = *s.implicit;
    Vector f = as_vector(s.state.f);
    if (s.setup->solver.budget && parts.h_before > 0 && parts.unbalanced.size() > 0) f -= parts.unbalanced;
    const Vector of_forces = (parts.mass.array() > 0).select(f.array() / parts.mass.array(), 0);
    return of_forces - s.setup->solver.damping * *v_start;
  }

 private:
  ImplicitStepper& stepper_;
  double start_, end_;  // s, of the step
};

template <class Real>
std::optional<StopReason> ImplicitStepper<Real>::take_best_iterate(double until) {
  takes_best_ = true;
  const bool done = step(Integrator::backward_euler, until - s_.state.time, until);
  takes_best_ = false;
  s_.implicit->h_before = 0;  // BDF2 starts anew
  if (!done) {
    if (s_.interrupted) return std::nullopt;
    return keep_last_solved(s_, out_of_range(s_, undefined_at_, until));
  }
  ++s_.substeps;
  return std::nullopt;
}

/// A given step that the scene's method cannot take, by backward Euler (after Rannacher 1984): a start far from
/// equilibrium is damped, and second-order steps go on from there.
template <class Real>
bool ImplicitStepper<Real>::damped_step(double h, double time_after) {
  if (!s_.setup->solver.step || s_.method == Integrator::backward_euler) return false;
  if (!step(Integrator::backward_euler, h, time_after)) return false;
  ++s_.stats.damped_steps;
  return true;
}

/// Whether most of the velocity is what incomplete solves have left in stiff elements: flying on for h would strain
/// the body as modes of ω h > 2 do. The trapezoidal rule turns that round from step to step; one step of backward Euler
/// damps it. Asked under a budget, of bodies whose potential tells, and of all after a step that was put back, which
/// solves no equation that an acceleration could be taken from.
template <class Real>
bool ImplicitStepper<Real>::is_noisy(double h, double time_after) {
  if (!s_.setup->solver.budget || s_.method != Integrator::tr_bdf2) return false;
  ImplicitState<Real>& parts = s_.implicit_state();
  if (parts.h_before > 0 && parts.unbalanced.size() == 0) return true;
  if (s_.has_internal_state || !s_.contacts.empty()) return false;
  const Vector x = as_vector(s_.state.x), v = as_vector(s_.state.v);
  parts.body.set_time(time_after, s_.setup->gravity);
  parts.body.move_tools(time_after);
  const auto here = parts.body.value(x), there = parts.body.value(x + h * v);
  Vector f;
  if (!here || !parts.body.residual(x, f)) return false;
  const double round_off = round_off_fraction * parts.body.value_round_off();
  return !there || *there - *here + h * f.dot(v) > resolved * kinetic_energy(parts, v) + round_off;
}

/// A step that does not converge with plastic flow in it, with flow after it: the stress it ends at is of the flow
/// before it. So with a step far beyond yield of tissue that hardly hardens.
template <class Real>
bool ImplicitStepper<Real>::lagging_step(double h, double time_after) {
  if (!s_.body.flows_within_steps() || s_.interrupted) return false;
  s_.implicit_state().body.set_flow_lags(true);
  const bool done = step(s_.method, h, time_after);
  s_.implicit_state().body.set_flow_lags(false);
  if (done) ++s_.stats.lagging_flow_steps;
  return done;
}

template <class Real>
bool ImplicitStepper<Real>::step(Integrator method, double h, double time_after) {
  ImplicitState<Real>& parts = s_.implicit_state();
  parts.x = as_vector(s_.state.x);
  parts.v = as_vector(s_.state.v);
  parts.body.begin_step(parts.x, s_.state.time);
  StagedStep step(*this, h, time_after);
  bool done = visit_integrator<bool>(method, [&](auto row) {
    if constexpr (row.info.kind == IntegratorKind::implicit_steps) return row.step(step);
    assert(false);  // TypedWorld::advance calls for implicit methods alone
    return false;
  });
  Vector &x = step.x, &v = step.v;
  if (done && s_.method != Integrator::backward_euler && !takes_any_iterate()) {
    const bool paid = take_back_gain(s_, h, time_after, x, v), is_damped = method == Integrator::backward_euler;
    done = is_damped || (paid && !(s_.setup->solver.step && parts.body.inverts_elements(parts.x, x)));
  }
  if (!done) {
    if (s_.has_internal_state) s_.body.begin_step(0);
    return false;
  }
  bool was_put_back = false;
  if (takes_any_iterate()) {
    const Vector solved = x;
    if (limit_energy(s_, h, time_after, takes_best_, x, v)) {
      parts.step.residual(x, residual_);  // forces are taken from what the objective saw last
      s_.stats.residual = parts.body.relative_residual(residual_);
      was_put_back = x != solved;
    }
  }
  parts.body.end_step(x);
  parts.x_before = parts.x;
  parts.v_before = parts.v;
  parts.h_before = h;
  parts.unbalanced = was_put_back ? Vector() : residual_;
  s_.set_state(x, v, time_after);
  if (s_.has_internal_state) {
    s_.body.commit(s_.state.x.data());
    s_.body.begin_step(0);
  }
  ++s_.steps;
  return true;
}

/// From x (the start of the step or of the stage) to the end of a stage, in x and v. h: s since the start of the step.
template <class Real>
bool ImplicitStepper<Real>::solve_stage(const Stage& stage, double h, double time, Vector& x, Vector& v) {
  ImplicitState<Real>& parts = s_.implicit_state();
  const double damping = s_.setup->solver.damping;
  if (s_.has_internal_state) s_.body.begin_step(static_cast<Real>(h));
  parts.body.set_time(time, s_.setup->gravity);
  parts.body.set_velocity(stage.d, stage.x_bar);
  parts.step.set(stage.a(damping), stage.y(damping));
  parts.linear.set_inertia(stage.a(damping));
  const int substeps = probe_substeps(h);
  parts.body.move_tools(time - h * (substeps - 1) / substeps);
  if (s_.setup->solver.budget) expect_contact(s_, stage, time, x);
  x = stage_start(s_, stage, time, x);
  NewtonResult result;
  bool is_lagging = false;  // contact pairs or friction still change with each solve
  for (int substep = 1; substep <= substeps; ++substep) {
    if (substep > 1) parts.body.move_tools(time - h * (substeps - substep) / substeps);
    bool is_rough = !s_.contacts.empty() && !s_.setup->solver.budget;  // while contact changes with each solve
    for (long spent = 0;;) {
      result = minimise_stage(is_rough ? rough_limit : 0, x);
      s_.stats.iterations += result.iterations;
      spent += result.iterations;
      if (s_.interrupted) return false;
      if (result.status == NewtonResult::Status::undefined || s_.setup->solver.budget) break;
      const bool was_rough = is_rough;
      is_rough = is_lagging = parts.body.update_lagged(x);
      const bool gives_up = spent > max_failed_iterations && !s_.setup->solver.step && !takes_any_iterate();
      if (is_lagging ? gives_up : !was_rough) break;
    }
    if (is_lagging) break;
  }
  parts.step.residual(x, residual_);
  s_.stats.residual = parts.body.relative_residual(residual_);
  undefined_at_.clear();
  if (result.status == NewtonResult::Status::undefined) {
    for (const double value : x) undefined_at_.push_back(static_cast<Real>(value));
    return false;
  }
  if (is_lagging) return false;
  if (!result.converged() && !takes_any_iterate() && !is_balanced_enough(stage, residual_)) return false;
  v = stage.velocity(x);
  for (const ConstrainedNode& constrained : s_.model->constrained)
    set_along(constrained.axes, constrained.node, prescribed_at(*s_.model, constrained, time).v, v);
  for (const PinnedPatch& pin : s_.pins)
    for (const int n : pin.nodes) v.segment<3>(3 * n).setZero();
  return true;
}

/// Into how many parts what a probe goes in h, s, is divided: it meets tissue at the end of each, and does not pass it.
template <class Real>
int ImplicitStepper<Real>::probe_substeps(double h) const {
  if (!s_.contacts.probe) return 1;
  const double travel = (s_.contacts.probe->tip(s_.state.time + h) - s_.contacts.probe->tip(s_.state.time)).norm();
  const double parts = std::ceil(2 * travel / s_.contacts.probe->radius());
  return static_cast<int>(std::clamp(parts, 1.0, 1.0 * max_probe_substeps));
}

template <class Real>
NewtonResult ImplicitStepper<Real>::minimise_stage(double least_limit, Vector& x) {
  ImplicitState<Real>& parts = s_.implicit_state();
  const int most = s_.setup->solver.budget ? stage_iterations() : NewtonOptions{}.max_iterations;
  parts.linear.limit_iterations(s_.setup->solver.budget ? s_.setup->solver.budget->linear : 0);
  StoppingCriterion criterion = stage_criterion();
  criterion.limit = std::max(criterion.limit, least_limit);
  criterion.interrupted = &s_.interrupted;
  if (s_.setup->solver.minimiser == Minimiser::lbfgs) {
    const int patience = s_.setup->solver.budget ? most : quasi_patience * most;
    const NewtonResult result = minimise_lbfgs(parts.step, parts.linear, criterion, patience, x);
    if (result.converged() || s_.setup->solver.budget || result.status == NewtonResult::Status::undefined)
      return result;
  }
  NewtonOptions options;
  options.max_iterations = most;
  options.projects_first = s_.setup->solver.budget.has_value();
  return minimise(parts.step, parts.linear, criterion, options, x);
}

/// `solver.tolerance` of scenes: the residual relative to the forces carried.
template <class Real>
StoppingCriterion ImplicitStepper<Real>::stage_criterion() {
  ImplicitState<Real>& parts = s_.implicit_state();
  return {[&parts](const Vector& r) { return parts.body.relative_residual(r); }, s_.setup->solver.relative_tolerance()};
}

/// Whether a step may end where Newton's method can do no more: a tolerance that was given decides alone; without one,
/// by what is left of acceleration, since an imbalance relative to small loads is beyond a stiff body's round-off.
template <class Real>
bool ImplicitStepper<Real>::is_balanced_enough(const Stage& stage, const Vector& r) {
  if (s_.setup->solver.tolerance) return false;
  ImplicitState<Real>& parts = s_.implicit_state();
  const double noise =
      parts.body.acceleration_round_off() + 0x1p-52 * stage.a(s_.setup->solver.damping) * s_.model->diagonal;
  return parts.body.max_acceleration(r) <=
         std::max(slack_of_motion * std::max(s_.setup->gravity.norm(), earth), 10 * noise);
}

template <class Real>
int ImplicitStepper<Real>::stage_iterations() const {
  const Budget& budget = *s_.setup->solver.budget;
  if (budget.iterations > 0) return budget.iterations;
  const double stages = info_of(s_.method).stages;
  const double cost = seconds_an_iteration * static_cast<double>(s_.model->mesh.tets.size());
  return static_cast<int>(std::clamp<double>(budget.milliseconds / 1000 / (stages * cost), 1, max_iterations));
}

template <class Real>
std::shared_ptr<PreconditionerBuild> ImplicitStepper<Real>::preconditioner_build() {
  if (!s_.implicit) return nullptr;
  preconditioner_build_ = s_.implicit->linear.preconditioner_build();
  preconditioner_version_ = s_.topology->version;
  return preconditioner_build_;
}

/// What another thread has made, where it is of the body as it is; else the same, made here and now.
template <class Real>
void ImplicitStepper<Real>::adopt_preconditioner() {
  const bool serves =
      preconditioner_build_ && preconditioner_build_->done() && preconditioner_version_ == s_.topology->version;
  const auto work = serves ? std::exchange(preconditioner_build_, nullptr) : preconditioner_build();
  preconditioner_build_.reset();
  if (!work || !s_.implicit || !s_.implicit->linear.is_outdated()) return;
  if (!serves) work->run();
  s_.implicit->linear.adopt(*work);
}

template class ImplicitStepper<float>;
template class ImplicitStepper<double>;

}  // namespace heml
