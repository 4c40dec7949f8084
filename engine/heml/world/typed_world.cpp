#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/dynamics/explicit.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {

constexpr double safety = 0.9;  // of the live limit; the bound is taken anew every few steps
// Of cut tissue: a cut sets the smallest pieces swinging by as much as their own size, and the limit changes meanwhile.
constexpr double safety_of_pieces = 0.7;
constexpr double safety_of_shreds = 0.5;
// The limit swings with a body that is crushed, lands, or hangs by a corner. Steps that grow in its rhythm feed the
// swing.
constexpr double growth_of_steps = 0.001;  // a step, at most
// The limit is taken anew when it may have changed by so much, as fast as it changed last time.
constexpr double change_between_bounds = 0.02;
constexpr double steps_between_bounds_when_calm = 32;  // at most: then taking it costs hardly anything
constexpr int steps_between_bounds_at_first = 8;
constexpr int steps_between_bounds_when_driven = 2;  // a hand can do much to a body in little time
constexpr std::size_t node_grain = 4096, coordinate_grain = 3 * node_grain;
constexpr std::size_t cached_coordinates = 2048;  // which the first cache has still when they are read again

std::vector<Material> materials_of(const WorldSetup& setup) {
  std::vector<Material> materials;
  for (const RegionMaterial& entry : setup.materials) materials.push_back(entry.material);
  return materials;
}

/// Whether |v| ≤ most for all coordinates [begin, end); not so where one is not a number.
template <class Real>
bool all_within(const Real* v, std::size_t begin, std::size_t end, Real most) {
  using Count = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;  // of one size: the loop vectorises
  Count within = 0;
  for (std::size_t i = begin; i < end; ++i) within += std::abs(v[i]) <= most ? Count(1) : Count(0);
  return static_cast<std::size_t>(within) == end - begin;
}

}  // namespace

template <class Real>
TypedWorld<Real>::TypedWorld(WorldSetup setup)
    : setup_(std::move(setup)),
      model_(make_model<Real>(setup_)),
      topology_(std::make_shared<const Topology>(whole(setup_.mesh))),
      body_(model_.mesh, model_.material_of, materials_of(setup_),
            {setup_.solver.continuation, setup_.solver.nodal_pressure, setup_.instruction_set, setup_.solver.threads}),
      team_(setup_.solver.threads) {
  const FlushDenormals flush;
  contacts_.tables = setup_.tables;
  for (Table& table : contacts_.tables) table.normal.normalize();
  update_masses();
  start();
}

template <class Real>
void TypedWorld<Real>::update_masses() {
  remembers_ = body_.has_internal_state();
  mass_ = body_.masses();
  inverse_mass_.resize(mass_.size());
  for (std::size_t n = 0; n < mass_.size(); ++n) inverse_mass_[n] = mass_[n] > 0 ? 1 / mass_[n] : Real(0);
  for (const ConstrainedNode& constrained : model_.constrained)
    inverse_mass_[static_cast<std::size_t>(constrained.node)] = 0;
  for (const PinnedPatch& pin : pins_)
    for (const int n : pin.nodes) inverse_mass_[static_cast<std::size_t>(n)] = 0;
  inverse_mass_per_dof_.clear();
  for (const Real inverse_mass_per_dof : inverse_mass_)
    inverse_mass_per_dof_.insert(inverse_mass_per_dof_.end(), 3, inverse_mass_per_dof);
  for (auto& grasp : grasps_) grasp.update_masses(inverse_mass_);
}

template <class Real>
void TypedWorld<Real>::start() {
  if (!pins_.empty()) {
    pins_.clear();
    update_masses();
  }
  contacts_.probe.reset();
  contacts_.sutures.clear();
  contacts_.reports.clear();
  update_self_contact();
  update_contact_surfaces();
  const std::size_t nodes = model_.mesh.nodes.size();
  state_.x.resize(3 * nodes);
  state_.v.assign(3 * nodes, 0);
  state_.f.assign(3 * nodes, 0);
  state_.time = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < 3; ++i)
      state_.x[3 * n + i] = static_cast<Real>(model_.mesh.nodes[n][static_cast<int>(i)]);
  rest_frequency_ = std::sqrt(body_.frequency_bound(state_.x.data(), team_));
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto file = static_cast<std::size_t>(model_.order.file_node[n]);
      const int axis = static_cast<int>(i);
      if (!setup_.initial_positions.empty())
        state_.x[3 * n + i] = static_cast<Real>(setup_.initial_positions[file][axis]);
      if (inverse_mass_[n] > 0) state_.v[3 * n + i] = static_cast<Real>(setup_.initial_velocity[axis]);
    }
  halt_.reset();
  grasps_.clear();
  implicit_.reset();
  origin_tick_ = ticks_;
  move_constrained();
  body_.reset_history(state_.x.data());
  last_valid_ = state_;
  start_monitoring();
  if (!evaluate_forces()) restore_last_valid(StopReason::Cause::out_of_range);
  last_valid_ = state_;
  if (monitors()) monitor();
  find_stable_step();
  limit_at_start_ = stable_step_;
  method_ = choose_method();
}

template <class Real>
void TypedWorld<Real>::tick() {
  if (halt_) return;
  const FlushDenormals flush;
  substeps_ = 0;
  impulses_.begin_tick();
  if (setup_.tearing && !recovering() && !setup_.solver.is_static()) tear();
  if (setup_.solver.integrator == Integrator::automatic) reconsider_method();
  const double until = static_cast<double>(ticks_ - origin_tick_ + 1) * setup_.solver.tick();
  advance(until);
  if (halt_) return;
  unfinished_ = state_.time < until;
  if (!unfinished_) ++ticks_;
}

template <class Real>
void TypedWorld<Real>::advance_within_tick(double time) {
  if (halt_) return;
  const FlushDenormals flush;
  advance(time);
}

template <class Real>
void TypedWorld<Real>::advance(double until) {
  ++changes_;
  if (setup_.solver.is_static()) {
    load_to(ramp(until, setup_.solver.load_duration()));
    if (!halt_ && !interrupted_) state_.time = until;
    return;
  }
  while (state_.time < until && !halt_ && !interrupted_) {
    if (recovering())
      recover(until);
    else if (is_explicit(method_))
      advance_explicit(until);
    else
      advance_implicit(until);
    if (monitors()) monitor();
  }
}

template <class Real>
void TypedWorld<Real>::advance_explicit(double until) {
  while (state_.time < until && !halt_ && !recovering() && !interrupted_) {
    const double h = choose_step(until);
    if (halt_ || recovering()) return;
    const bool last = state_.time + 1.5 * h > until;
    const double after = last ? until : state_.time + h;
    step(static_cast<Real>(after - state_.time), after);
    ++substeps_;
  }
}

/// The given step, or an equal share of what is left at the live limit.
template <class Real>
double TypedWorld<Real>::choose_step(double until) {
  const double left = until - state_.time;
  if (setup_.solver.step) return left;
  const bool has_torn = !edits_.empty() && edits_.back().torn > 0;  // shreds are let go stretched, and snap back
  const bool is_driven = !grasps_.empty() || contacts_.probe || has_torn;
  const int most = is_driven ? steps_between_bounds_when_driven : steps_until_supports_strain();
  if (++steps_since_bound_ >= std::min(bound_interval_, most)) update_stable_step();
  if (!(stable_step_ > min_step)) {
    stop(StopReason{StopReason::Cause::unstable, -1, -1, why_no_step()});
    return left;
  }
  return left / std::ceil(left / stable_step_);
}

template <class Real>
std::string TypedWorld<Real>::why_no_step() const {
  if (stable_step_ > 0)
    return fmt::format(
        "stopped at t = {:.6g} s: an explicit method would need steps of {:.3g} s; "
        "soften the material or improve the mesh's worst element",
        state_.time, stable_step_);
  return fmt::format(
      "stopped at t = {:.6g} s: the stiffness of the body is no number that {} precision can hold, so far is it "
      "stretched or crushed: no step is short enough (load it more gently{})",
      state_.time, single_ ? "single" : "double", single_ ? ", or take \"precision\": \"double\"" : "");
}

/// In how many steps the fastest support strains what is next to it by as much as the limit may change between bounds.
template <class Real>
int TypedWorld<Real>::steps_until_supports_strain() const {
  if (!(stable_step_ > 0)) return steps_between_bounds_when_driven;
  double fastest = 0;
  for (std::size_t k = 0; k < model_.prescribed_motions.size(); ++k)
    if (state_.time < model_.prescribed_motions[k].ramp_time) fastest = std::max(fastest, model_.speeds[k]);
  const double steps = change_between_bounds * model_.spacing / (fastest * stable_step_);
  return static_cast<int>(std::clamp<double>(steps, steps_between_bounds_when_driven, steps_between_bounds_when_calm));
}

template <class Real>
void TypedWorld<Real>::step(Real h, double time_after) {
  switch (method_) {
    case Integrator::symplectic_euler:
      return step_with<SymplecticEuler<Real>>(h, time_after);
    default:
      return step_with<Verlet<Real>>(h, time_after);
  }
}

template <class Real>
template <class Method>
void TypedWorld<Real>::step_with(Real h, double time_after) {
  State<Real>& s = state_;
  const Real damping = static_cast<Real>(setup_.solver.damping);
  const Real* inverse_mass_per_dof = inverse_mass_per_dof_.data();
  std::swap(s.x, last_valid_.x);
  std::swap(s.v, last_valid_.v);
  last_valid_.time = s.time;
  s.x.resize(inverse_mass_per_dof_.size());
  s.v.resize(inverse_mass_per_dof_.size());

  const FirstHalfStep<Real> first{inverse_mass_per_dof, s.f.data(), last_valid_.x.data(),
                                  last_valid_.v.data(), s.x.data(), s.v.data()};
  team_.parallel_for(inverse_mass_per_dof_.size(), coordinate_grain, [&](std::size_t begin, std::size_t end) {
    Method::first_half_step(h, damping, first, begin, end);
  });
  if (!contacts_.empty())
    impulses_.first_half_step(contacts_, last_valid_.time, time_after,
                              Method::damping_divisor(static_cast<double>(h), setup_.solver.damping), inverse_mass_,
                              last_valid_.x.data(), s.x.data(), s.v.data());
  s.time = time_after;
  move_constrained();
  if (remembers_) body_.begin_step(h);
  if (!evaluate_forces()) return restore_last_valid(StopReason::Cause::out_of_range);
  // Ten times its own size in a step, or not a number: no tissue does that.
  const Real fastest = static_cast<Real>(10 * (model_.diagonal / h + setup_.initial_velocity.norm()));
  std::atomic<bool> sane{true};
  team_.parallel_for(inverse_mass_per_dof_.size(), coordinate_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t some = begin; some < end; some += cached_coordinates) {
      const std::size_t last = std::min(end, some + cached_coordinates);
      Method::second_half_step(h, damping, inverse_mass_per_dof, s.f.data(), s.v.data(), some, last);
      if (!all_within(s.v.data(), some, last, fastest)) sane.store(false, std::memory_order_relaxed);
    }
  });
  if (!sane) return restore_last_valid(StopReason::Cause::unstable);
  if (!contacts_.empty()) impulses_.second_half_step(contacts_, inverse_mass_, s.x.data(), s.v.data());
  if (remembers_) {
    body_.commit(s.x.data());
    body_.begin_step(0);
  }
  ++steps_;
}

template <class Real>
void TypedWorld<Real>::move_constrained() {
  for (const ConstrainedNode& constrained : model_.constrained) {
    const PrescribedMotion::At at = prescribed_at(model_, constrained, state_.time);
    Eigen::Map<Vector3<Real>>(&state_.x[3 * static_cast<std::size_t>(constrained.node)]) = at.x.template cast<Real>();
    Eigen::Map<Vector3<Real>>(&state_.v[3 * static_cast<std::size_t>(constrained.node)]) = at.v.template cast<Real>();
  }
  for (const PinnedPatch& pin : pins_)
    for (std::size_t k = 0; k < pin.nodes.size(); ++k) {
      const auto n = 3 * static_cast<std::size_t>(pin.nodes[k]);
      Eigen::Map<Vector3<Real>>(&state_.x[n]) = pin.place[k].template cast<Real>();
      Eigen::Map<Vector3<Real>>(&state_.v[n]).setZero();
    }
}

/// In a static world gravity is ramped with everything else.
template <class Real>
Vec3 TypedWorld<Real>::gravity_now() const {
  return (setup_.solver.is_static() ? ramp(state_.time, setup_.solver.load_duration()) : 1) * setup_.gravity;
}

/// Forces from all sides but supports at the present positions. Returns whether every law is defined there.
template <class Real>
bool TypedWorld<Real>::evaluate_forces() {
  const Real* x = state_.x.data();
  Real* f = state_.f.data();
  const bool valid = acting_body().forces(x, f, team_);
  const Vector3<Real> g = gravity_now().template cast<Real>();
  if (!g.isZero(0))
    team_.parallel_for(mass_.size(), node_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n)
        for (std::size_t i = 0; i < 3; ++i) f[3 * n + i] += mass_[n] * g[static_cast<int>(i)];
    });
  for (const auto& load : model_.dead) add_load(load, state_.time, f);
  for (const auto& load : model_.pressures) add_load(load, state_.time, x, f);
  for (const auto& grasp : grasps_) grasp.add_forces(x, state_.v.data(), f);
  if (!contacts_.empty() && implicit_ && !is_explicit(method_) && !recovering()) {
    Vector contact = Vector::Zero(static_cast<Eigen::Index>(state_.x.size()));
    implicit_->body.add_contact(as_vector(state_.x), contact);
    for (std::size_t i = 0; i < state_.f.size(); ++i) f[i] += static_cast<Real>(contact[static_cast<Eigen::Index>(i)]);
  }
  return valid;
}

/// h with h²λ + 2h c < 4: elastic bound λ and, where something is grasped, its ω²; damping that lags half a step
/// behind, c = 2ω of a grasp and what viscosity adds.
template <class Real>
void TypedWorld<Real>::find_stable_step() {
  ElasticBody<Real>& body = acting_body();
  double lambda = static_cast<double>(body.frequency_bound(state_.x.data(), team_)), omega = 0;
  for (const auto& grasp : grasps_) omega = std::max(omega, static_cast<double>(grasp.omega()));
  lambda += omega * omega;
  const double half = omega + (remembers_ ? static_cast<double>(body.damping_bound(state_.x.data(), team_)) / 2 : 0);
  const bool cut = std::any_of(edits_.begin(), edits_.end(), [](const EditReport& edit) { return edit.split > 0; });
  const bool torn = std::any_of(edits_.begin(), edits_.end(), [](const EditReport& edit) { return edit.torn > 0; });
  const double part = torn ? safety_of_shreds : cut ? safety_of_pieces : safety;
  stable_step_ = part * 2 / (half + std::sqrt(half * half + lambda));
  steps_since_bound_ = 0;
  bound_interval_ = steps_between_bounds_at_first;
}

/// Takes it anew, and after that the sooner the faster it changes.
template <class Real>
void TypedWorld<Real>::update_stable_step() {
  const double before = stable_step_;
  const int steps = steps_since_bound_, interval = bound_interval_;
  find_stable_step();
  const double change = std::abs(stable_step_ / before - 1);
  const double enough = std::isfinite(change) ? steps * change_between_bounds / std::max(change, 1e-9) : 1;
  bound_interval_ = static_cast<int>(std::clamp(enough, 1.0, std::min(2.0 * interval, steps_between_bounds_when_calm)));
  stable_step_ = std::min(stable_step_, (1 + steps * growth_of_steps) * before);
}

/// At positions, 3 #V, that were to be those at a time, s.
template <class Real>
StopReason TypedWorld<Real>::out_of_range(const std::vector<Real>& x, double time) const {
  StopReason halt{StopReason::Cause::out_of_range, -1, -1, {}};
  const int element = body_.first_undefined(x.data());
  if (element >= 0) halt.element = model_.order.file_tet[static_cast<std::size_t>(element)];
  halt.message = fmt::format(
      "{} left the range of its law at t = {:.6g} s: it was {} ({}take a smaller step, or load more gently)",
      element < 0 ? "an element" : fmt::format("element {}", halt.element), time,
      setup_.solver.continuation ? "deformed so far that its forces overflow" : "pressed flat or turned inside out",
      setup_.solver.continuation ? "" : "set solver.continuation to true, ");
  return halt;
}

template <class Real>
void TypedWorld<Real>::restore_last_valid(StopReason::Cause cause) {
  StopReason halt{cause, -1, -1, {}};
  const double reached = state_.time, h = state_.time - last_valid_.time;
  if (cause == StopReason::Cause::out_of_range) {
    halt = out_of_range(state_.x, reached);
  } else {
    const auto wild = std::find_if(state_.v.begin(), state_.v.end(), [&](Real v) {
      return !(std::abs(v) <= 10 * (model_.diagonal / h + setup_.initial_velocity.norm()));
    });
    if (wild != state_.v.end())
      halt.node = model_.order.file_node[static_cast<std::size_t>(wild - state_.v.begin()) / 3];
    halt.message = fmt::format(
        "unstable at t = {:.6g} s: node {} ran away with steps of {:.3g} s{}", reached, halt.node, h,
        std::isfinite(limit_at_start_) ? fmt::format("; at the start the limit was {:.3g} s", limit_at_start_) : "");
  }
  state_.x = last_valid_.x;
  state_.v = last_valid_.v;
  state_.time = last_valid_.time;
  if (remembers_) body_.begin_step(0);
  evaluate_forces();
  stop(halt);
}

/// The world goes no further as it is: halted, or brought back where the scene asks for that.
template <class Real>
void TypedWorld<Real>::stop(const StopReason& halt) {
  if (!can_recover(halt)) {
    halt_ = halt;
    return;
  }
  StateCheck seen = recovery_->check(model_.mesh, state_, mass_);
  const auto& file_tet = model_.order.file_tet;
  if (halt.element >= 0)
    seen.worst = static_cast<int>(std::find(file_tet.begin(), file_tet.end(), halt.element) - file_tet.begin());
  begin_recovery(seen);
}

std::unique_ptr<World> make_world(WorldSetup setup) {
  if (setup.solver.single_precision) return std::make_unique<TypedWorld<float>>(std::move(setup));
  return std::make_unique<TypedWorld<double>>(std::move(setup));
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
