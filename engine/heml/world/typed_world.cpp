#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/world/conditions.hpp>
#include <heml/world/failure.hpp>
#include <heml/world/stable_step.hpp>
#include <heml/world/typed_world.hpp>
#include <tuple>
#include <type_traits>

namespace heml {

namespace {

/// Whether two worlds began with the same body, so that snapshots of one fit the other; all else of a setup is part of
/// a snapshot. Edits append to a mesh, so it begins with what it was. size: of both at the start.
bool same_body(const MeshSize& size, const WorldSetup& a, const WorldSetup& b) {
  const auto options = [](const WorldSetup& setup) {
    const SolverSettings& solver = setup.solver;
    return std::tuple(solver.continuation, solver.nodal_pressure, solver.recovery, solver.is_static(),
                      solver.mass_scaling, resolve(setup.instruction_set));
  };
  const auto begin_alike = [](const auto& one, const auto& other, std::size_t count) {
    return std::equal(one.begin(), one.begin() + static_cast<std::ptrdiff_t>(count), other.begin());
  };
  return options(a) == options(b) && begin_alike(a.mesh.nodes, b.mesh.nodes, size.nodes) &&
         begin_alike(a.mesh.tets, b.mesh.tets, size.tets) &&
         std::equal(a.mesh.fields.begin(), a.mesh.fields.end(), b.mesh.fields.begin(), b.mesh.fields.end(),
                    [&](const ElementField& one, const ElementField& other) {
                      return one.name == other.name && one.components == other.components &&
                             begin_alike(one.values, other.values, size.tets * one.components);
                    });
}

}  // namespace

template <class Real>
TypedWorld<Real>::TypedWorld(WorldSetup setup)
    : s_(std::move(setup)), opened_(s_.setup), at_start_{s_.setup->mesh.nodes.size(), s_.setup->mesh.tets.size()} {
  const FlushDenormals flush;
  start();
}

template <class Real>
TypedWorld<Real>::TypedWorld(const TypedSnapshot<Real>& snapshot)
    : s_(snapshot.simulation), opened_(snapshot.opened), at_start_(snapshot.at_start) {
  editor_.restore_history(snapshot.edits);
  actions_.restore(snapshot.actions);
}

/// The phases of a tick. Commands were applied before it (apply), what it did is read after it (queries_).
template <class Real>
void TypedWorld<Real>::tick() {
  if (s_.halt) return;
  const FlushDenormals flush;
  s_.substeps = 0;
  s_.impulses.begin_tick();
  editor_.contract();    // burnt tissue shrinks on
  editor_.tear();        // elements separate where they are overstretched
  method_.reconsider();  // "auto": explicit or implicit
  const double until = s_.origin_time + static_cast<double>(s_.ticks - s_.origin_tick + 1) * s_.setup->solver.tick();
  advance(until);  // static increments, or steps of the method, contacts included, and recovery
  if (s_.halt) return;
  s_.unfinished = s_.state.time < until;
  if (!s_.unfinished) ++s_.ticks;
}

template <class Real>
void TypedWorld<Real>::advance(double until) {
  ++s_.changes;
  if (s_.setup->solver.is_static()) {
    load_to(Ramp{0, s_.setup->solver.load_duration()}(until));
    if (!s_.is_stopped()) s_.state.time = until;
    return;
  }
  while (s_.state.time < until && !s_.is_stopped()) {
    if (s_.recovering())
      recovery_.step(until);
    else if (is_explicit(s_.method))
      handle(explicit_.advance(until));
    else if (!rescue_.goes_on(until))
      handle_implicit(implicit_.advance(until), until);
    handle(recovery_.monitor());
  }
}

template <class Real>
void TypedWorld<Real>::advance_within_tick(double time) {
  if (s_.halt) return;
  const FlushDenormals flush;
  advance(time);
}

template <class Real>
void TypedWorld<Real>::load_to(double fraction) {
  if (s_.halt) return;
  handle(static_.load_to(fraction));
}

/// A failed step begins a recovery where the scene asks for that, else halts the world.
template <class Real>
void TypedWorld<Real>::handle(const std::optional<StopReason>& failure) {
  if (failure && !recovery_.takes_over(*failure)) s_.halt = failure;
}

/// Recovery comes first where the body is in bad shape, because a rescue keeps that shape; else the rescue ends the
/// tick.
template <class Real>
void TypedWorld<Real>::handle_implicit(const std::optional<StopReason>& failure, double until) {
  if (failure && !recovery_.takes_over(*failure)) s_.halt = rescue_.end_tick(until, *failure);
}

template <class Real>
Status TypedWorld<Real>::apply(const Command& command) {
  const FlushDenormals flush;
  if (const auto* step = std::get_if<StepHistory>(&command)) return step_history(step->by);
  if (!s_.setup->keeps_actions) return carry_out(command);
  const bool begins = actions_.begins_action(command, s_.ticks, s_.setup->solver.tick(), s_.contacts.probe.has_value());
  auto before = begins ? moment() : nullptr;
  Status status = carry_out(command);
  if (status.ok()) actions_.carried_out(command, s_.ticks, std::move(before));
  return status;
}

template <class Real>
Status TypedWorld<Real>::carry_out(const Command& command) {
  if (!is_edit(command)) ++s_.changes;
  s_.is_evaluated = false;
  if (s_.implicit && s_.implicit->equilibrium) s_.implicit->equilibrium->invalidate();
  Status status;
  if (const auto* reset = std::get_if<Reset>(&command)) {
    if (reset->scene) return reopen(), Status();
    editor_.undo_all();
    restart_ramps(s_);  // time begins anew
    start();
  } else {
    status = std::visit(
        [this]<class C>(const C& c) -> Status {
          if constexpr (std::is_same_v<C, Reset> || std::is_same_v<C, StepHistory>)
            return {};  // above
          else
            return commands_.execute(c);
        },
        command);
  }
  if (status.ok() && !s_.halt && !s_.is_evaluated) {
    if (!s_.evaluate_forces()) handle(restore_last_valid(s_, StopReason::Cause::out_of_range));
    find_stable_step(s_);
  }
  return status;
}

/// As a world made anew of the same scene, at its first tick. Ticks go on, and so does what was learnt of the clock.
template <class Real>
void TypedWorld<Real>::reopen() {
  const long ticks = s_.ticks;
  const double elapsed = s_.elapsed();
  const std::optional<double> step_cost = s_.step_cost;
  const std::optional<Budget> budget = s_.setup->solver.budget;
  WorldSetup setup = *opened_;
  if (setup.solver.budget && setup.solver.budget->milliseconds > 0 && budget)
    setup.solver.budget->iterations = budget->iterations;
  TypedWorld fresh(std::move(setup));
  heml::restore(take_snapshot(fresh.s_), s_);
  editor_.restore_history({});
  s_.ticks = s_.origin_tick = s_.rate_tick = ticks;
  s_.elapsed_before_rate = elapsed;
  s_.step_cost = step_cost;
  method_.choose();
}

/// Returns to the moment before the last action, or to the one that was left. Time goes back with the state; ticks, by
/// which events are due, go on.
template <class Real>
Status TypedWorld<Real>::step_history(int by) {
  if (by != -1 && by != 1) return fmt::format("history: must be -1 (undo) or 1 (redo), is {}", by);
  if (!actions_.can_step(by)) return by < 0 ? "history: there is nothing to undo" : "history: there is nothing to redo";
  const auto then = actions_.step(by, moment());
  const double elapsed = s_.elapsed();
  const long ticks = s_.ticks, since = ticks - then->simulation.values.ticks;
  heml::restore(then->simulation, s_);
  editor_.restore_history(then->edits);
  s_.ticks = ticks;
  s_.origin_tick += since;
  s_.rate_tick = ticks;
  s_.elapsed_before_rate = elapsed;
  if (s_.explicit_until >= 0) s_.explicit_until += since;
  s_.is_evaluated = true;
  return {};
}

template <class Real>
std::shared_ptr<const Moment<Real>> TypedWorld<Real>::moment() {
  return std::make_shared<const Moment<Real>>(Moment<Real>{take_snapshot(s_), editor_.history()});
}

template <class Real>
ActionList TypedWorld<Real>::actions() const {
  ActionList list;
  for (const auto& entry : actions_.lists().past) list.past.push_back(entry.action);
  const auto& future = actions_.lists().future;
  for (auto entry = future.rbegin(); entry != future.rend(); ++entry) list.future.push_back(entry->action);
  return list;
}

/// At construction and on Reset.
template <class Real>
void TypedWorld<Real>::start() {
  if (!s_.pins.empty()) {
    s_.pins.clear();
    s_.update_masses();
  }
  s_.contacts.probe.reset();
  s_.contacts.sutures.clear();
  s_.contacts.reports.clear();
  s_.update_self_contact();
  set_initial_state();
  s_.place_tables();
  s_.halt.reset();
  s_.explicit_until = -1;
  s_.grasps.clear();
  s_.implicit.reset();
  s_.origin_tick = s_.ticks;
  s_.origin_time = 0;
  s_.move_constrained();
  s_.body.reset_history(s_.state.x.data());
  s_.last_valid = s_.state;
  recovery_.start();
  if (!s_.evaluate_forces()) handle(restore_last_valid(s_, StopReason::Cause::out_of_range));
  s_.last_valid = s_.state;
  handle(recovery_.monitor());
  find_stable_step(s_);
  s_.limit.at_start = s_.limit.stable;
  method_.choose();
}

/// Positions and velocities of the scene, or the rest shape; bounds the frequency at rest.
template <class Real>
void TypedWorld<Real>::set_initial_state() {
  const std::size_t nodes = s_.model->mesh.nodes.size();
  s_.state.x.resize(3 * nodes);
  s_.state.v.assign(3 * nodes, 0);
  s_.state.f.assign(3 * nodes, 0);
  s_.state.time = 0;
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < 3; ++i)
      s_.state.x[3 * n + i] = static_cast<Real>(s_.model->mesh.nodes[n][static_cast<int>(i)]);
  s_.rest_frequency = std::sqrt(s_.body.frequency_bound(s_.state.x.data(), s_.team));
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto file = static_cast<std::size_t>(s_.model->order.file_node[n]);
      const int axis = static_cast<int>(i);
      if (!s_.setup->initial_positions.empty())
        s_.state.x[3 * n + i] = static_cast<Real>(s_.setup->initial_positions[file][axis]);
      if (s_.masses->inverse[n] > 0) s_.state.v[3 * n + i] = static_cast<Real>(s_.setup->initial_velocity[axis]);
    }
}

template <class Real>
std::shared_ptr<const WorldSnapshot> TypedWorld<Real>::snapshot() {
  const FlushDenormals flush;
  auto snapshot = std::make_shared<TypedSnapshot<Real>>();
  snapshot->at_start = at_start_;
  snapshot->opened = opened_;
  snapshot->simulation = take_snapshot(s_);
  snapshot->edits = editor_.history();
  snapshot->actions = actions_.lists();
  return snapshot;
}

template <class Real>
Status TypedWorld<Real>::restore(const WorldSnapshot& snapshot) {
  const FlushDenormals flush;
  const auto* of_type = dynamic_cast<const TypedSnapshot<Real>*>(&snapshot);
  if (!of_type) return "restore: the snapshot is of a world of the other precision";
  const SimulationSnapshot<Real>& saved = of_type->simulation;
  if (of_type->at_start != at_start_ || !same_body(at_start_, *saved.setup, *s_.setup))
    return "restore: the snapshot is of another body (mesh, or options of its solver)";
  heml::restore(saved, s_);
  editor_.restore_history(of_type->edits);
  actions_.restore(of_type->actions);
  return {};
}

template <class Real>
bool TypedWorld<Real>::copy_motion_from(const World& leader) {
  const auto* other = dynamic_cast<const TypedWorld*>(&leader);
  if (!other) return false;
  const Simulation<Real>& o = other->s_;
  if (o.halt || o.has_internal_state || s_.has_internal_state || o.recovering() || s_.recovering()) return false;
  if (o.model->order.file_node != s_.model->order.file_node || o.model->order.file_tet != s_.model->order.file_tet)
    return false;
  ++s_.changes;
  s_.state = o.state;
  s_.move_constrained();
  s_.last_valid = s_.state;
  s_.grasps = o.grasps;
  s_.impulses.set_memory(o.impulses.memory());
  s_.limit.stable = o.limit.stable;
  s_.limit.found = o.limit.found;
  s_.frequency_bounds.forget();
  s_.damping_bounds.forget();
  s_.halt.reset();
  if (s_.implicit) s_.implicit->h_before = 0;  // BDF2 restarts
  return true;
}

template <class Real>
SolverStats TypedWorld<Real>::solver_stats() const {
  SolverStats stats = s_.stats;
  stats.integrator = integrator_name(s_.method);
  if (s_.setup->solver.budget) stats.budget = implicit_.stage_iterations();
  if (!s_.implicit) return stats;
  stats.preconditioner = preconditioner_names[static_cast<std::size_t>(s_.implicit->linear.preconditioner())];
  stats.linear = s_.implicit->linear.counts();
  return stats;
}

template <class Real>
WorldFacts TypedWorld<Real>::facts() {
  const FlushDenormals flush;
  WorldFacts facts;
  facts.nodes = s_.setup->mesh.nodes.size();
  facts.tets = s_.setup->mesh.tets.size();
  facts.live_tets = s_.topology->elements.size();
  for (const AxisSet& held : held_axes(*s_.model)) facts.constrained_nodes += held.are_none() ? 0 : 1;
  facts.faces = s_.model->loaded_faces.triangles.size();
  facts.threads = s_.team.size();
  facts.kernels = s_.body.kernels();
  facts.method = method_.facts();
  facts.step = queries_.step_facts();
  facts.solver = queries_.solver_facts();
  const bool has_past = editor_.has_history() || actions_.can_step(-1);
  const std::size_t past = (editor_.has_history() ? editor_.history_bytes() : 0) + actions_.bytes();
  facts.memory = queries_.memory_facts(has_past ? std::optional(past) : std::nullopt);
  return facts;
}

std::unique_ptr<World> make_world(WorldSetup setup) {
  use_double_far_away(setup);
  use_double_for_memory(setup);
  if (setup.solver.single_precision) return std::make_unique<TypedWorld<float>>(std::move(setup));
  return std::make_unique<TypedWorld<double>>(std::move(setup));
}

std::unique_ptr<World> make_world_from(const WorldSnapshot& snapshot) {
  if (const auto* single = dynamic_cast<const TypedSnapshot<float>*>(&snapshot))
    return std::make_unique<TypedWorld<float>>(*single);
  return std::make_unique<TypedWorld<double>>(dynamic_cast<const TypedSnapshot<double>&>(snapshot));
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
