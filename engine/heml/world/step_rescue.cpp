#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <heml/world/energy_limit.hpp>
#include <heml/world/stable_step.hpp>
#include <heml/world/step_rescue.hpp>
#include <utility>

namespace heml {

std::string rescue_message(const SolverStats& stats) {
  if (stats.explicit_rescues + stats.unconverged_steps == 0) return {};
  std::string message =
      fmt::format("implicit steps did not converge: explicit substeps ended {} of the ticks", stats.explicit_rescues);
  if (stats.unconverged_steps > 0)
    message += fmt::format(", unconverged steps {}, which leave up to {:.3g} of the forces unbalanced",
                           stats.unconverged_steps, stats.unconverged_residual);
  return message;
}

/// What explicit substeps change, to undo them.
template <class Real>
struct StepRescue<Real>::Start {
  State<Real> state;
  std::optional<BodySnapshot<Real>> body;  ///< of materials with internal state
  std::vector<ContactReport> reports;
  long steps;
  int substeps;
};

template <class Real>
typename StepRescue<Real>::Start StepRescue<Real>::save() {
  Start start{s_.state, std::nullopt, s_.contacts.reports, s_.steps, s_.substeps};
  if (s_.has_internal_state) start.body = s_.body.snapshot();
  return start;
}

template <class Real>
void StepRescue<Real>::restore(const Start& start) {
  s_.state = start.state;
  s_.last_valid = start.state;
  if (start.body) s_.body.restore(*start.body, s_.state.x.data());
  s_.contacts.reports = start.reports;
  s_.steps = start.steps;
  s_.substeps = start.substeps;
  s_.impulses.begin_tick();
}

template <class Real>
std::optional<StopReason> StepRescue<Real>::end_tick(double until, const StopReason& failure) {
  if (s_.setup->solver.step) return failure;
  s_.explicit_until = s_.ticks + ticks_of_rescue;
  if (take_explicit_substeps(until)) {
    ++s_.stats.explicit_rescues;
    return std::nullopt;
  }
  if (const auto undefined = implicit_.take_best_iterate(until)) return undefined;
  if (s_.state.time < until) return std::nullopt;  // interrupted
  ++s_.stats.unconverged_steps;
  s_.stats.unconverged_residual = std::max(s_.stats.unconverged_residual, s_.stats.residual);
  return std::nullopt;
}

template <class Real>
bool StepRescue<Real>::goes_on(double until) {
  if (s_.ticks >= s_.explicit_until || !take_explicit_substeps(until)) return false;
  ++s_.stats.explicit_rescues;
  return true;
}

/// Returns false, with nothing changed but the memory of implicit contact, where they do not reach `until`.
template <class Real>
bool StepRescue<Real>::take_explicit_substeps(double until) {
  find_stable_step(s_);
  if (!(max_explicit_substeps * s_.limit.stable >= until - s_.state.time)) return false;
  const Start start = save();
  ImplicitState<Real>& parts = s_.implicit_state();
  parts.body.reset_contact();  // contact acts by impulses now, and its energy begins anew afterwards
  parts.h_before = 0;          // BDF2 starts anew
  const std::optional<double> before = energy(until);
  const Integrator method = std::exchange(s_.method, Integrator::verlet);
  s_.impulses.begin_tick();
  const bool reached = s_.evaluate_forces() && !explicit_.advance(until, max_explicit_substeps) &&
                       s_.state.time == until && (!before || limit_gain(*before, until));
  s_.method = method;
  s_.last_valid = s_.state;
  if (reached)
    s_.stats.residual = 0;  // explicit steps solve no equation
  else
    restore(start);
  return reached;
}

/// Takes from the velocities what energy exceeds that before, those within parts first. Returns false where they do not
/// have as much.
template <class Real>
bool StepRescue<Real>::limit_gain(double before, double until) {
  const double gain = *energy(until) - before;
  if (gain <= 0) return true;
  Vector v = as_vector(s_.state.v);
  const double moving = kinetic_energy(*s_.implicit, v);
  if (!(gain <= moving)) return false;
  slow_down(s_, moving - gain, as_vector(s_.state.x), v);
  for (std::size_t i = 0; i < s_.state.v.size(); ++i)
    s_.state.v[i] = static_cast<Real>(v[static_cast<Eigen::Index>(i)]);
  return true;
}

/// Of motion, elasticity and potential of all loads as at a time, s: it falls where nothing but them does work. None
/// where something else does: pressure; supports, tables, a probe or sutures that move.
template <class Real>
std::optional<double> StepRescue<Real>::energy(double time) {
  const auto& tables = s_.contacts.tables;
  const bool tables_rise = std::any_of(tables.begin(), tables.end(),
                                       [this](const PlacedTable& placed) { return placed.rises(s_.state.time); });
  if (s_.contacts.probe || !s_.contacts.sutures.empty() || tables_rise || supports_move(*s_.model, s_.state.time, time))
    return std::nullopt;
  BodyObjective<Real>& body = s_.implicit_state().body;
  const Vector x = as_vector(s_.state.x);
  body.set_time(time, s_.setup->gravity);
  body.set_velocity(0, x);
  const std::optional<double> potential = body.value(x);
  if (!potential) return std::nullopt;
  const Energies energies = s_.energies();
  return energies.kinetic + energies.elastic + *potential - s_.body.potential(s_.state.x.data(), s_.team);
}

template class StepRescue<float>;
template class StepRescue<double>;

}  // namespace heml
