#include <algorithm>
#include <cassert>
#include <cmath>
#include <heml/world/stable_step.hpp>
#include <limits>

namespace heml {
namespace {
// Of the live limit; the bound is evaluated again every few steps.
constexpr double safety = 0.9;
// Of cut or torn tissue: what is left, most of all the smallest pieces, swings by as much as its own size, and the
// limit changes meanwhile (step_strain.hpp).
constexpr double safety_of_pieces = 0.7;
// The limit oscillates with a body that is crushed, lands, or hangs by a corner. Steps that grow in that rhythm feed
// the oscillation.
constexpr double growth_of_steps = 0.001;  // per step, at most
// The bound is evaluated again when the limit may have changed by this much, judged by how fast it changed last time.
constexpr double change_between_bounds = 0.02;
constexpr double steps_between_bounds_when_calm = 32;  // at most: its cost is then negligible
constexpr int steps_between_bounds_at_first = 8;
// Nodes so near to what a hand holds are evaluated each time, whatever their bounds were.
constexpr double watched_spacings = 1;

/// Whether the elements watched are those of the grasps there are.
template <class Real>
bool watches_grasps(const Simulation<Real>& s) {
  return std::equal(s.grasps.begin(), s.grasps.end(), s.limit.watched.begin(), s.limit.watched.end(),
                    [](const GraspSpring<Real>& grasp, long serial) { return grasp.id().serial == serial; });
}

/// Chooses the elements that hands deform.
template <class Real>
void watch_grasps(Simulation<Real>& s) {
  const std::vector<Vec3>& rest = s.model->mesh.nodes;
  std::vector<bool> is_near(rest.size(), false);
  s.limit.watched.clear();
  for (const auto& grasp : s.grasps) {
    s.limit.watched.push_back(grasp.id().serial);
    const Vec3& place = rest[static_cast<std::size_t>(grasp.center())];
    const double radius = static_cast<double>(grasp.radius()) + watched_spacings * s.model->spacing;
    for (std::size_t n = 0; n < rest.size(); ++n)
      if ((rest[n] - place).squaredNorm() <= radius * radius) is_near[n] = true;
  }
  std::vector<int> nodes;
  for (std::size_t n = 0; n < rest.size(); ++n)
    if (is_near[n]) nodes.push_back(static_cast<int>(n));
  s.damping_bounds.watch(nodes);
  s.frequency_bounds.watch(std::move(nodes));
}

/// Whether the masses are those that the body's bounds are of.
template <class Real>
[[maybe_unused]] bool has_masses_of_bounds(Simulation<Real>& s) {
  constexpr Real round_off = static_cast<Real>(1e-4);
  const std::vector<Real>& factors = s.body.mass_factors(s.team);
  const std::vector<Real>&lumped = s.masses->lumped, masses = s.body.masses();
  for (std::size_t n = 0; n < factors.size(); ++n)
    if (!(std::abs(lumped[n] - factors[n] * masses[n]) <= round_off * lumped[n])) return false;
  return true;
}

template <class Real>
void forget_bounds(Simulation<Real>& s) {
  s.frequency_bounds.forget();
  s.damping_bounds.forget();
}

/// The stable step (s) from the bounds of all elements that may allow less than `longest` (s; 0: unknown).
template <class Real>
double evaluate_bounds(Simulation<Real>& s, double longest) {
  ElasticBody<Real>& body = s.acting_body();
  const int steps = s.limit.steps_since_bound;
  double omega = 0, of_hands = 0;
  for (const auto& grasp : s.grasps) {  // hands may hold the same node: all that pulls at one
    of_hands += static_cast<double>(grasp.omega()) * static_cast<double>(grasp.omega());
    omega += static_cast<double>(grasp.omega());
  }
  const double half =
      omega + (s.has_internal_state
                   ? static_cast<double>(body.damping_bound(s.state.x.data(), s.team, s.damping_bounds, steps)) / 2
                   : 0);
  const bool cut = std::any_of(s.edits.begin(), s.edits.end(), [](const EditReport& edit) {
    return edit.split > 0 || edit.removed > 0 || edit.torn > 0;
  });
  const double part = cut ? safety_of_pieces : safety;
  const double rate = 2 * part / longest;  // what follows inverted, for the bound that `longest` bears
  const auto bearable = static_cast<Real>(longest > 0 ? rate * rate - 2 * rate * half - of_hands : 0);
  const double lambda = of_hands + static_cast<double>(body.frequency_bound(s.state.x.data(), s.team,
                                                                            s.frequency_bounds, steps, bearable));
  s.limit.steps_since_bound = 0;
  return part * 2 / (half + std::sqrt(half * half + lambda));
}
}  // namespace

template <class Real>
void find_stable_step(Simulation<Real>& s) {
  assert(has_masses_of_bounds(s));
  watch_grasps(s);  // also for the same grasps: elements may have other places
  forget_bounds(s);
  s.limit.stable = s.limit.found = evaluate_bounds(s, 0);
  s.limit.interval = steps_between_bounds_at_first;
  s.limit.of_strain = std::numeric_limits<double>::infinity();
  s.limit.steps_to_strain = 0;
}

template <class Real>
void update_stable_step(Simulation<Real>& s) {
  const double before = s.limit.stable;
  const int steps = s.limit.steps_since_bound, interval = s.limit.interval;
  if (!watches_grasps(s)) watch_grasps(s);
  if (s.contacts.probe) forget_bounds(s);  // it may touch any element
  const double longest = (1 + steps * growth_of_steps) * before, found = evaluate_bounds(s, longest);
  s.limit.stable = std::min(found, longest);
  // Of what was found, since the step in use may be far below it.
  const double change = std::abs(found - s.limit.found) / s.limit.stable;
  s.limit.found = found;
  const double enough = std::isfinite(change) ? steps * change_between_bounds / std::max(change, 1e-9) : 1;
  s.limit.interval =
      static_cast<int>(std::clamp(enough, 1.0, std::min(2.0 * interval, steps_between_bounds_when_calm)));
}

template <class Real>
void need_stable_step(Simulation<Real>& s) {
  s.limit.interval = 1;
}

template <class Real>
int steps_until_strained(const Simulation<Real>& s) {
  if (!(s.limit.stable > 0)) return steps_between_bounds_when_driven;
  double fastest = 0;
  for (std::size_t k = 0; k < s.model->prescribed_motions.size(); ++k)
    if (s.model->prescribed_motions[k].ramp.is_growing(s.state.time)) fastest = std::max(fastest, s.model->speeds[k]);
  for (const auto& grasp : s.grasps) fastest = std::max(fastest, grasp.speed_at_most(s.state.x.data()));
  const double steps = change_between_bounds * s.model->spacing / (fastest * s.limit.stable);
  return static_cast<int>(std::clamp<double>(steps, steps_between_bounds_when_driven, steps_between_bounds_when_calm));
}

template void find_stable_step(Simulation<float>& s);
template void update_stable_step(Simulation<float>& s);
template void need_stable_step(Simulation<float>& s);
template int steps_until_strained(const Simulation<float>& s);
template void find_stable_step(Simulation<double>& s);
template void update_stable_step(Simulation<double>& s);
template void need_stable_step(Simulation<double>& s);
template int steps_until_strained(const Simulation<double>& s);

}  // namespace heml
