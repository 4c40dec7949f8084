#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/dynamics/integrator_list.hpp>
#include <heml/elastic/avx2_dispatch.hpp>
#include <heml/world/explicit_stepper.hpp>
#include <heml/world/failure.hpp>
#include <heml/world/stable_step.hpp>

namespace heml {
namespace {

constexpr std::size_t coordinate_grain = 3 * 400;
constexpr double growth_after_strain = 0.05;      // a step, of steps after one that deformed an element too much
// Of the stable step: in shorter ones elements may be deformed as they will, so that time goes on.
constexpr double shortest_step = 1.0 / 64;
constexpr double most_over_rest = 1024;           // steps of a tick, over those at rest, before a recovery begins
constexpr std::size_t cached_coordinates = 2048;  // still in the first-level cache when they are read again

/// Whether |v| ≤ most for all coordinates [begin, end); false where one is NaN.
template <class Real>
bool all_within(const Real* v, std::size_t begin, std::size_t end, Real most) {
  using Count = std::conditional_t<sizeof(Real) == 4, std::int32_t, std::int64_t>;  // of one size: the loop vectorises
  Count within = 0;
  for (std::size_t i = begin; i < end; ++i) within += std::abs(v[i]) <= most ? Count(1) : Count(0);
  return static_cast<std::size_t>(within) == end - begin;
}

template <class Real, class Method>
HEML_WIDE void wide_first_half(Real h, Real damping, const FirstHalfStep<Real>& at, std::size_t begin,
                               std::size_t end) {
  Method::first_half_step(h, damping, at, begin, end);
}
template <class Real, class Method>
HEML_WIDE bool wide_second_half(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* v,
                                std::size_t begin, std::size_t end, Real fastest) {
  Method::second_half_step(h, damping, inverse_mass, f, v, begin, end);
  return all_within(v, begin, end, fastest);
}

template <class Real, class Method>
void first_half(Real h, Real damping, const FirstHalfStep<Real>& at, std::size_t begin, std::size_t end) {
  if (has_avx2()) return wide_first_half<Real, Method>(h, damping, at, begin, end);
  Method::first_half_step(h, damping, at, begin, end);
}
/// Returns whether all speeds are at most `fastest`.
template <class Real, class Method>
bool second_half(Real h, Real damping, const Real* inverse_mass, const Real* f, Real* v, std::size_t begin,
                 std::size_t end, Real fastest) {
  if (has_avx2()) return wide_second_half<Real, Method>(h, damping, inverse_mass, f, v, begin, end, fastest);
  Method::second_half_step(h, damping, inverse_mass, f, v, begin, end);
  return all_within(v, begin, end, fastest);
}

}  // namespace

template <class Real>
std::optional<StopReason> ExplicitStepper<Real>::advance(double until, long most) {
  const double begun = s_.state.time;
  for (long done = 0; s_.state.time < until && done < most && !s_.interrupted; ++done) {
    const StepOnTrial on_trial(trial_, s_.team);
    const double left = until - s_.state.time;
    double h = left;  // a given step is a whole tick
    if (!s_.setup->solver.step) {
      refresh_stable_step();
      if (!(s_.limit.stable > min_step) || (s_.recovery && static_cast<double>(done) > most_steps(until - begun)))
        return StopReason{StopReason::Cause::unstable, -1, -1, why_no_step()};
      h = left / std::ceil(left / std::min(s_.limit.stable, s_.limit.of_strain));
    }
    const bool last = s_.state.time + 1.5 * h > until;
    const double after = last ? until : s_.state.time + h;
    const auto failure = step(static_cast<Real>(after - s_.state.time), after);
    ++s_.substeps;
    if (failure && !may_try_shorter(*failure, std::min(h, s_.limit.of_strain))) return failure;
  }
  return std::nullopt;
}

/// In `time`, where the scene wants a recovery: elements so stretched or crushed that more are needed are not waited
/// for.
template <class Real>
double ExplicitStepper<Real>::most_steps(double time) const {
  return most_over_rest * std::ceil(time * static_cast<double>(s_.rest_frequency) / 2);
}

/// A given step is taken as it is; without cuts and contacts elements do not change so fast.
template <class Real>
bool ExplicitStepper<Real>::checks_strain() const {
  return !s_.setup->solver.step && (!s_.contacts.empty() || !s_.edits.empty());
}

/// Whether a step of h that failed may succeed if it is shorter: the next one will be. The state is that before it.
template <class Real>
bool ExplicitStepper<Real>::may_try_shorter(const StopReason& failure, double h) {
  if (failure.cause != StopReason::Cause::out_of_range || !checks_strain()) return false;
  if (!(h > shortest_step * s_.limit.stable)) return false;
  shorten(h / 2);
  return true;
}

/// The steps that follow are of h at most, and grow slowly; the contacts are those before the step.
template <class Real>
void ExplicitStepper<Real>::shorten(double h) {
  s_.limit.of_strain = h;
  s_.limit.steps_to_strain = 0;
  need_stable_step(s_);
  if (!s_.contacts.empty()) s_.impulses.restore(before_, s_.contacts);
}

/// Evaluates the stable step again when it may have changed.
template <class Real>
void ExplicitStepper<Real>::refresh_stable_step() {
  const bool has_torn = !s_.edits.empty() && s_.edits.back().torn > 0;  // torn pieces are released under tension
  const bool is_driven = s_.contacts.probe || has_torn;
  const int most = is_driven ? steps_between_bounds_when_driven : steps_until_strained(s_);
  if (++s_.limit.steps_since_bound >= std::min(s_.limit.interval, most)) update_stable_step(s_);
}

template <class Real>
std::string ExplicitStepper<Real>::why_no_step() const {
  if (s_.limit.stable > 0)
    return fmt::format(
        "stopped at t = {:.6g} s: an explicit method would need steps of {:.3g} s; "
        "soften the material or improve the mesh's worst element",
        s_.state.time, s_.limit.stable);
  return fmt::format(
      "stopped at t = {:.6g} s: the stiffness of the body is no number that {} precision can hold, so far is it "
      "stretched or crushed: no step is short enough (load it more gently{})",
      s_.state.time, sizeof(Real) == sizeof(float) ? "single" : "double",
      sizeof(Real) == sizeof(float) ? ", or take \"precision\": \"double\"" : "");
}

template <class Real>
std::optional<StopReason> ExplicitStepper<Real>::step(Real h, double time_after) {
  return visit_integrator<std::optional<StopReason>>(s_.method, [&](auto row) -> std::optional<StopReason> {
    if constexpr (row.info.kind == IntegratorKind::explicit_steps)
      return step_with<typename decltype(row)::template Scheme<Real>>(h, time_after);
    assert(false);  // TypedWorld::advance calls for explicit methods alone
    return std::nullopt;
  });
}

template <class Real>
template <class Method>
std::optional<StopReason> ExplicitStepper<Real>::step_with(Real h, double time_after) {
  State<Real>& s = s_.state;
  const Real damping = static_cast<Real>(s_.setup->solver.damping);
  const Real* inverse_mass_per_dof = s_.masses->inverse_per_dof.data();
  std::swap(s.x, s_.last_valid.x);
  std::swap(s.v, s_.last_valid.v);
  s_.last_valid.time = s.time;
  s.x.resize(s_.masses->inverse_per_dof.size());
  s.v.resize(s_.masses->inverse_per_dof.size());
  begin_bearable_step<Method>(h, time_after);
  if (s_.has_internal_state) s_.body.begin_step(h);
  if (!s_.evaluate_forces()) return restore_last_valid(s_, StopReason::Cause::out_of_range);
  // Ten times the size of the body in a step, or NaN: the step was unstable.
  const Real fastest = static_cast<Real>(10 * (s_.model->diagonal / h + s_.setup->initial_velocity.norm()));
  std::atomic<bool> sane{true};
  s_.team.parallel_for(s_.masses->inverse_per_dof.size(), coordinate_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t some = begin; some < end; some += cached_coordinates) {
      const std::size_t last = std::min(end, some + cached_coordinates);
      if (!second_half<Real, Method>(h, damping, inverse_mass_per_dof, s.f.data(), s.v.data(), some, last, fastest))
        sane.store(false, std::memory_order_relaxed);
    }
  });
  if (!sane) return restore_last_valid(s_, StopReason::Cause::unstable);
  if (!s_.contacts.empty()) s_.impulses.second_half_step(s_.contacts, s_.masses->inverse, s.x.data(), s.v.data());
  if (s_.has_internal_state) {
    s_.body.commit(s.x.data());
    s_.body.begin_step(0);
  }
  ++s_.steps;
  return std::nullopt;
}

/// The first half: positions and velocities up to the forces.
template <class Real>
template <class Method>
void ExplicitStepper<Real>::begin_step(Real h, double time_after) {
  State<Real>& s = s_.state;
  const Real damping = static_cast<Real>(s_.setup->solver.damping);
  const Real* inverse_mass_per_dof = s_.masses->inverse_per_dof.data();
  const FirstHalfStep<Real> first{inverse_mass_per_dof,   s.f.data(), s_.last_valid.x.data(),
                                  s_.last_valid.v.data(), s.x.data(), s.v.data()};
  s_.team.parallel_for(s_.masses->inverse_per_dof.size(), coordinate_grain, [&](std::size_t begin, std::size_t end) {
    first_half<Real, Method>(h, damping, first, begin, end);
  });
  if (!s_.contacts.empty())
    s_.impulses.first_half_step(s_.contacts, s_.last_valid.time, time_after,
                                Method::damping_divisor(static_cast<double>(h), s_.setup->solver.damping),
                                s_.masses->inverse, s_.last_valid.x.data(), s.x.data(), s.v.data());
  s.time = time_after;
  s_.move_constrained(true);
}

/// Lists the nodes at contacts, or those alone that were at none since all were asked for.
template <class Real>
void ExplicitStepper<Real>::list_contacts(bool all) {
  touched_.clear();
  if (s_.contacts.empty()) return;
  std::vector<char>& known = s_.limit.touched;
  if (all || known.size() != s_.masses->inverse.size()) known.assign(s_.masses->inverse.size(), 0);
  s_.impulses.list_nodes(touched_);
  std::erase_if(touched_, [&](int n) { return std::exchange(known[static_cast<std::size_t>(n)], 1) != 0; });
}

/// The same, half as long until it deforms no element too much (step_strain.hpp).
template <class Real>
template <class Method>
void ExplicitStepper<Real>::begin_bearable_step(Real& h, double time_after) {
  const bool has_contacts = !s_.contacts.empty(), is_checked = checks_strain();
  if (is_checked && has_contacts) s_.impulses.keep(s_.contacts, before_);
  begin_step<Method>(h, time_after);
  s_.limit.of_strain *= 1 + growth_after_strain;
  if (!has_contacts) s_.limit.touched.clear();  // those that come later are new
  if (!is_checked) return;
  while (true) {
    const bool is_due = s_.limit.steps_to_strain <= 1;
    list_contacts(is_due);
    if (!is_due && touched_.empty()) {
      --s_.limit.steps_to_strain;
      return;
    }
    strain_.adopt(*s_.model, *s_.topology, s_.setup->solver.continuation);
    const double strain = strain_.largest(touched_, is_due, s_.last_valid.x.data(), s_.state.x.data());
    const int calm = steps_until_strain(strain);
    s_.limit.steps_to_strain = is_due ? calm : std::min(calm, s_.limit.steps_to_strain - 1);
    if (!(strain > max_step_strain) || static_cast<double>(h) <= shortest_step * s_.limit.stable) return;
    h /= 2;
    shorten(static_cast<double>(h));
    begin_step<Method>(h, s_.last_valid.time + static_cast<double>(h));
  }
}

template class ExplicitStepper<float>;
template class ExplicitStepper<double>;

}  // namespace heml
