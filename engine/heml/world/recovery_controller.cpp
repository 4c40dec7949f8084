#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <heml/base/hash.hpp>
#include <heml/dynamics/backward_euler.hpp>
#include <heml/world/recovery_controller.hpp>
#include <heml/world/stable_step.hpp>
#include <limits>
#include <numbers>

namespace heml {
namespace {

constexpr double worst_J = -0.2;         // an element below it needs a recovery
constexpr double max_inverted = 0.01;    // of all elements
constexpr double min_healthy_J = 0.3;    // of every element, for a recovery to end
constexpr long calm_steps = 5;           // healthy steps that end a recovery if the body is calm
constexpr long moving_steps = 100;       // healthy steps that end it if loads keep the body moving
constexpr double calm_speed = 0.03;      // of the speed of shear waves
constexpr double max_speed_factor = 10;  // times the speed of waves and of the start: faster is no motion of tissue
constexpr double perturbation = 1e-5;    // of the body's size: 1 µm for 0.1 m
constexpr std::uint64_t perturbation_seed = 2018;
constexpr double collapsed_extent = 0.1;  // of the extent at rest
constexpr double tangled_speed = 0.1;  // of the speed of shear waves: a slower body with inverted elements is tangled
constexpr long max_moves_towards_rest = 30;  // steps: elements inverted for longer are kept so by constraints or loads
constexpr double collapsed_fraction = 0.01, tangled_fraction = 0.1;  // of the displacement to the rest shape, a step
constexpr double weight_of_constrained = 1000;                       // relative to free nodes, in the best fit
constexpr NewtonOptions newton_options{10, 1e-2};
constexpr double residual_reduction = 1e-3;  // of the first residual
constexpr double no_acceleration = 1e-2;     // m/s²

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
void RecoveryController<Real>::start() {
  const auto before = std::move(s_.recovery);
  if (!s_.setup->solver.recovery || s_.setup->solver.is_static()) return;
  RecoveryProgress<Real> progress;
  progress.max_speed = max_speed_factor * (max_wave_speed() + s_.setup->initial_velocity.norm());
  progress.last_good = s_.state;
  if (s_.has_internal_state) progress.last_good_internal = s_.body.internal_state();
  progress.reference = make_recovery_reference(*s_.model, s_.masses->lumped);
  // The one before may be shared.
  if (before && *before->reference == *progress.reference) progress.reference = before->reference;
  s_.recovery = std::make_unique<RecoveryState<Real>>(std::move(progress));
}

/// Speed of the fastest waves, which cross an element in about 2/ω_max, m/s.
template <class Real>
double RecoveryController<Real>::max_wave_speed() const {
  const double nodes = static_cast<double>(s_.masses->lumped.size());
  return static_cast<double>(s_.rest_frequency) * s_.model->diagonal / std::cbrt(nodes) / 2;
}

/// Speed of shear waves in the stiffest material, m/s.
template <class Real>
double RecoveryController<Real>::shear_wave_speed() const {
  double speed = 0;
  for (const RegionMaterial& entry : s_.setup->materials)
    speed = std::max(speed, std::sqrt(small_strain_moduli(entry.material).shear / entry.material.density));
  return speed > 0 ? speed : max_wave_speed();  // a net of springs is no continuum
}

template <class Real>
std::optional<StopReason> RecoveryController<Real>::monitor() {
  if (!s_.recovery || s_.recovering() || s_.halt) return std::nullopt;
  RecoveryState<Real>& recovery = *s_.recovery;
  recovery.track_tools(s_.grasps, s_.state.time);
  const StateCheck check = recovery.check(*s_.model, s_.state, s_.masses->lumped, s_.team);
  const double inverted = static_cast<double>(check.inverted) / static_cast<double>(s_.model->mesh.tets.size());
  if (!(check.min_J < worst_J || inverted > max_inverted || check.speed > recovery.max_speed)) {
    keep_state();
    recovery.has_last_good = true;
  } else if (is_step_hopeless()) {
    return StopReason{
        StopReason::Cause::unstable, -1, -1,
        fmt::format(
            "unstable at t = {:.6g} s: steps of {:.3g} s are too long for this body, which at rest bears {:.3g} s",
            s_.state.time, s_.setup->solver.step.value_or(min_step), 2 / static_cast<double>(s_.rest_frequency))};
  } else {
    begin(check);
  }
  return std::nullopt;
}

/// Whether an explicit method is told to take steps, or would need some so small, that it cannot go on even at rest.
template <class Real>
bool RecoveryController<Real>::is_step_hopeless() const {
  const double limit_at_rest = 2 / static_cast<double>(s_.rest_frequency);
  return is_explicit(s_.setup->solver.integrator) && !(limit_at_rest > s_.setup->solver.step.value_or(min_step));
}

template <class Real>
bool RecoveryController<Real>::takes_over(const StopReason& failure) {
  if (!s_.recovery || s_.recovering() || is_step_hopeless()) return false;
  StateCheck check = s_.recovery->check(*s_.model, s_.state, s_.masses->lumped, s_.team);
  if (failure.cause == StopReason::Cause::not_converged && !(check.min_J < min_healthy_J)) return false;
  const auto& file_tet = s_.model->order.file_tet;
  if (failure.element >= 0)
    check.worst = static_cast<int>(std::find(file_tet.begin(), file_tet.end(), failure.element) - file_tet.begin());
  begin(check);
  return true;
}

template <class Real>
void RecoveryController<Real>::follow_change() {
  if (s_.recovering())
    s_.install_surrogate();
  else if (s_.recovery)
    keep_state();
}

template <class Real>
void RecoveryController<Real>::keep_state() {
  s_.recovery->last_good = s_.state;
  s_.recovery->last_good_internal = s_.has_internal_state ? s_.body.internal_state() : InternalState<Real>();
}

/// To the last good state. Time that passed since has not acted on the materials, and friction begins anew.
template <class Real>
void RecoveryController<Real>::go_back() {
  const RecoveryState<Real>& recovery = *s_.recovery;
  static_cast<Motion<Real>&>(s_.state) = recovery.last_good;
  s_.impulses.set_memory({});
  if (s_.implicit) s_.implicit->body.reset_contact();
  if (!s_.has_internal_state) return;
  s_.body.set_internal_state(recovery.last_good_internal);
  s_.body.begin_step(0);
}

/// check: of the state that the recovery replaces.
template <class Real>
void RecoveryController<Real>::begin(const StateCheck& check) {
  RecoveryState<Real>& recovery = *s_.recovery;
  FailureDiagnosis suspects = diagnose(check);
  Recovery report;
  report.tick = s_.ticks;
  report.element = suspects.element;
  report.inverted = check.inverted;
  report.min_J = check.min_J;
  report.message = describe_cause(suspects);
  go_back();
  report.begun.time = s_.state.time;
  report.begun.before = s_.energies();
  if (s_.body.first_undefined(s_.state.x.data()) >= 0)
    report.begun.before.elastic = std::numeric_limits<double>::quiet_NaN();
  perturb();
  s_.install_surrogate();
  s_.evaluate_forces();
  report.begun.after = s_.energies();
  recovery.last = report;
  recovery.healthy_steps = recovery.moves_towards_rest = 0;
  recovery.is_tangled = false;
  ++recovery.count;
}

template <class Real>
FailureDiagnosis RecoveryController<Real>::diagnose(const StateCheck& check) const {
  FailureDiagnosis s;
  s.time = s_.state.time;
  s.min_J = check.min_J;
  s.inverted = check.inverted;
  s.from_start = !s_.recovery->has_last_good;
  s.tool_speed = s_.recovery->tool_speed;
  s.pulled = !s_.grasps.empty();
  s.loaded = is_loaded();
  s.wave_speed = shear_wave_speed();
  s.thinness = thinness(s_.model->mesh, check.worst);
  if (s_.setup->solver.step && is_explicit(s_.setup->solver.integrator)) {
    s.step = *s_.setup->solver.step;
    s.limit = s_.limit.stable;
  } else if (is_explicit(s_.method)) {
    s.shortened = 2 / static_cast<double>(s_.rest_frequency) / s_.limit.stable;
  }
  if (check.min_J >= min_healthy_J && check.speed > s_.recovery->max_speed) return s;
  s.element = s_.model->order.file_tet[static_cast<std::size_t>(check.worst)];
  s.burn_shrink = burn_shrink_at(check.worst);
  const int material = s_.model->material_of[static_cast<std::size_t>(check.worst)];
  const SmallStrainModuli rest = small_strain_moduli(s_.setup->materials[static_cast<std::size_t>(material)].material);
  if (rest.shear > 0) s.stiffness_ratio = rest.bulk / rest.shear;
  return s;
}

/// The largest part that an element, or one beside it, has lost of its lengths at rest.
template <class Real>
double RecoveryController<Real>::burn_shrink_at(int element) const {
  const TetMesh& mesh = s_.model->mesh;
  if (mesh.burns.empty()) return 0;
  const Tet& here = mesh.tets[static_cast<std::size_t>(element)];
  double shrink = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto is_here = [&](int node) { return std::find(here.begin(), here.end(), node) != here.end(); };
    if (std::any_of(mesh.tets[t].begin(), mesh.tets[t].end(), is_here))
      shrink = std::max(shrink, 1 - rest_scale(mesh, t));
  }
  return shrink;
}

/// Whether anything but tools in a hand deforms the body.
template <class Real>
bool RecoveryController<Real>::is_loaded() const {
  const WorldSetup& setup = *s_.setup;
  const auto moves = [](const Boundary& entry) { return entry.translate.norm() > 0 || entry.degrees != 0; };
  return setup.gravity.norm() > 0 || !setup.loads.empty() || !s_.pins.empty() || s_.contacts.has_tools() ||
         std::any_of(setup.boundary.begin(), setup.boundary.end(), moves);
}

/// At exact coincidence all forces are zero.
template <class Real>
void RecoveryController<Real>::perturb() {
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n) {
    if (!(s_.masses->inverse[n] > 0)) continue;
    std::uint64_t random = hash_combine(perturbation_seed, static_cast<std::uint64_t>(s_.model->order.file_node[n]));
    for (std::size_t i = 0; i < 3; ++i) {
      random = hash_combine(random, std::uint64_t{i});
      const double part = static_cast<double>(random >> 11) * 0x1p-52 - 1;
      s_.state.x[3 * n + i] += static_cast<Real>(perturbation * s_.model->diagonal * part);
    }
  }
}

template <class Real>
void RecoveryController<Real>::step(double until) {
  step_surrogate(until);
  RecoveryState<Real>& recovery = *s_.recovery;
  const StateCheck check = recovery.check(*s_.model, s_.state, s_.masses->lumped, s_.team);
  recovery.healthy_steps = check.min_J > min_healthy_J ? recovery.healthy_steps + 1 : 0;
  const bool is_calm = check.speed <= calm_speed * shear_wave_speed();
  if (recovery.healthy_steps >= (is_calm ? calm_steps : moving_steps)) end();
}

/// One step, whatever Newton's method reaches: Φ does not rise.
template <class Real>
void RecoveryController<Real>::step_surrogate(double until) {
  ImplicitState<Real>& implicit = s_.recovery->surrogate->implicit;
  // A collapsed body, whose forces are too small to expand it, or a tangled one at a minimum of energy is moved towards
  // its rest shape.
  const StateCheck check = s_.recovery->check(*s_.model, s_.state, s_.masses->lumped, s_.team);
  if (check.extent < collapsed_extent) move_towards_rest(collapsed_fraction);
  if (check.inverted == 0 && !s_.recovery->is_folded(s_.state))
    s_.recovery->is_tangled = false;
  else if (s_.recovery->last->steps > 0 && check.speed <= tangled_speed * shear_wave_speed())
    s_.recovery->is_tangled = true;
  if (s_.recovery->is_tangled && s_.recovery->moves_towards_rest < max_moves_towards_rest) {
    move_towards_rest(tangled_fraction);
    ++s_.recovery->moves_towards_rest;
  }
  const double h = until - s_.state.time;
  implicit.x = as_vector(s_.state.x);
  implicit.v = as_vector(s_.state.v);
  const Stage stage = backward_euler_stage(implicit.x, implicit.v, h);
  // Critical for the slowest mode, which is about a wave to and fro.
  const double damping =
      std::max(s_.setup->solver.damping, 2 * std::numbers::pi * shear_wave_speed() / s_.model->diagonal);
  implicit.body.begin_step(implicit.x, s_.state.time);
  implicit.body.set_time(until, s_.setup->gravity);
  implicit.body.set_velocity(stage.d, stage.x_bar);
  implicit.step.set(stage.a(damping), stage.y(damping));
  implicit.linear.set_inertia(stage.a(damping));
  Vector stay = implicit.x, fly = (implicit.mass.array() > 0).select(stage.y(damping), stay);
  for (const ConstrainedNode& constrained : s_.model->constrained)
    for (Vector* x : {&stay, &fly})
      set_along(constrained.axes, constrained.node, prescribed_at(*s_.model, constrained, until).x, *x);
  const auto staying = implicit.step.value(stay), flying = implicit.step.value(fly);
  Vector x = flying && *flying < *staying ? fly : stay, r;
  implicit.step.residual(x, r);
  const double first = r.norm();
  const StoppingCriterion stop{
      [&](const Vector& left) {
        const auto push = (implicit.mass.array() > 0).select(left.array() / implicit.mass.array(), 0);
        return std::min(push.abs().maxCoeff() / no_acceleration, left.norm() / (residual_reduction * first));
      },
      1};
  s_.stats.iterations += minimise(implicit.step, implicit.linear, stop, newton_options, x).iterations;
  implicit.step.residual(x, r);  // whose forces are kept
  implicit.body.end_step(x);
  s_.set_state(x, stage.velocity(x), until);
  s_.move_constrained();
  ++s_.steps;
  ++s_.substeps;
  ++s_.recovery->last->steps;
}

/// Moves free nodes by a part of their displacement to the rest shape, which is placed by the rigid motion that fits
/// the constrained nodes best, or the whole body where they are too few.
template <class Real>
void RecoveryController<Real>::move_towards_rest(double part) {
  Vec3 x_mean = Vec3::Zero(), X_mean = Vec3::Zero();
  double mass = 0;
  const auto x = [&](std::size_t n) { return Eigen::Map<Vector3<Real>>(&s_.state.x[3 * n]); };
  const auto& X = s_.model->mesh.nodes;
  const auto weight = [&](std::size_t n) {
    return static_cast<double>(s_.masses->lumped[n]) * (s_.masses->inverse[n] > 0 ? 1 : weight_of_constrained);
  };
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n) {
    const double m = weight(n);
    x_mean += m * x(n).template cast<double>();
    X_mean += m * X[n];
    mass += m;
  }
  x_mean /= mass;
  X_mean /= mass;
  Mat3 moment = Mat3::Zero();
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n)
    moment += weight(n) * (x(n).template cast<double>() - x_mean) * (X[n] - X_mean).transpose();
  const Eigen::JacobiSVD<Mat3> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  const Mat3 R = svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  for (std::size_t n = 0; n < s_.masses->lumped.size(); ++n) {
    if (!(s_.masses->inverse[n] > 0)) continue;
    const Vec3 displacement = x_mean + R * (X[n] - X_mean) - x(n).template cast<double>();
    x(n) += (part * displacement).template cast<Real>();
  }
}

/// Returns to the scene's law, unless it is undefined at the current positions; then the recovery continues.
template <class Real>
void RecoveryController<Real>::end() {
  RecoveryState<Real>& recovery = *s_.recovery;
  if (s_.body.first_undefined(s_.state.x.data()) >= 0) return;
  LawSwitch back{s_.state.time, s_.energies(), {}};
  recovery.surrogate.reset();
  if (s_.has_internal_state) {  // the recovery is one step of the internal state
    s_.body.begin_step(static_cast<Real>(s_.state.time - recovery.last->begun.time));
    s_.body.commit(s_.state.x.data());
    s_.body.begin_step(0);
  }
  if (s_.implicit) s_.implicit->h_before = 0;
  s_.evaluate_forces();
  back.after = s_.energies();
  recovery.last->ended = back;
  s_.last_valid = s_.state;
  keep_state();
  find_stable_step(s_);
  method_.choose();
}

template class RecoveryController<float>;
template class RecoveryController<double>;

}  // namespace heml
