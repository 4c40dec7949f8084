#include <algorithm>
#include <cmath>
#include <heml/world/energy_limit.hpp>
#include <heml/world/stage_start.hpp>
#include <limits>

namespace heml {
namespace {

constexpr double slack_of_energy = 1e-10;    // of a step's energy: what it may gain
constexpr double round_off_fraction = 1e-2;  // of the bound on the round-off of energies: what sums of elements reach
constexpr int max_halvings = 42;             // of the way: a third of them towards each of the places below

/// Whether nothing but gravity and held nodes acts from outside: then the motion of free parts as a whole is no matter
/// of a step's energy.
template <class Real>
bool flies_alone(const Simulation<Real>& s) {
  return s.model->dead.empty() && s.model->pressures.empty() && s.grasps.empty() && s.contacts.empty();
}

template <class Real>
bool may_flow(const ElasticBody<Real>& body) {
  return std::any_of(body.materials().begin(), body.materials().end(),
                     [](const Material& material) { return material.plasticity.has_value(); });
}

struct Released {
  double energy, before;  ///< J: on the way, and what there was at its start
};

/// What body and loads give up from parts.x to x in a step of h, s; nothing where that is unknown. What tissue that
/// relaxes gives up is between that with the memory of the step's start and that with the memory of its end, so the
/// larger counts.
template <class Real>
std::optional<Released> released(const Simulation<Real>& s, double h, const Vector& x, ImplicitState<Real>& parts) {
  const auto now = [&]() -> std::optional<Released> {
    const auto after = parts.body.value(x), before = parts.body.value(parts.x);
    if (!after || !before) return std::nullopt;
    return Released{*before - *after, *before};
  };
  const auto with_end = now();
  if (!s.has_internal_state) return with_end;
  parts.body.begin_memory_step(0);
  const auto with_start = now();
  parts.body.begin_memory_step(h);
  return with_end && with_start && with_end->energy > with_start->energy ? with_end : with_start;
}

}  // namespace

template <class Real>
double kinetic_energy(const ImplicitState<Real>& parts, const Vector& v) {
  return (parts.mass.array() * v.array().square()).sum() / 2;
}

template <class Real>
void slow_down(const Simulation<Real>& s, double left, const Vector& x, Vector& v) {
  const ImplicitState<Real>& parts = *s.implicit;
  const Vector rigid = s.implicit->rigid_motions(*s.model).velocity(x, v), inner = v - rigid;
  const double whole = kinetic_energy(parts, rigid), within = kinetic_energy(parts, inner);
  const double of_whole = left < whole ? std::sqrt(left / whole) : 1;
  const double of_inner = left > whole && within > 0 ? std::sqrt((left - whole) / within) : 0;
  v = (parts.mass.array() > 0).select(of_whole * rigid + of_inner * inner, v);
}

template <class Real>
bool take_back_gain(Simulation<Real>& s, double h, double time, const Vector& x, Vector& v) {
  ImplicitState<Real>& parts = s.implicit_state();
  if (parts.free.node.empty() || may_flow(s.body) || !s.grasps.empty() || !s.contacts.empty() ||
      supports_move(*s.model, s.state.time, time))
    return true;
  const auto given = released(s, h, x, parts);
  if (!given) return true;
  const double moved = kinetic_energy(parts, parts.v), moves = kinetic_energy(parts, v);
  const double may = given->energy + moved;
  // What round-off makes of energies is no gain: taken from every step of a long motion it would add up.
  const double round_off =
      round_off_fraction * parts.body.value_round_off() + std::numeric_limits<Real>::epsilon() * moved;
  if (moves == 0 || !(moves > may + slack_of_energy * (moved + std::abs(given->before)) + round_off)) return true;
  if (!flies_alone(s)) {
    v *= std::sqrt(std::max(may, 0.0) / moves);
    return may >= 0 || moves - may <= round_off;
  }
  const RigidMotions& motions = parts.rigid_motions(*s.model);
  const Vector rigid = motions.velocity(x, v), inner = v - rigid;
  const double moves_within = kinetic_energy(parts, inner);
  const double moved_within = moved - kinetic_energy(parts, motions.velocity(parts.x, parts.v));
  const double may_within =
      given->energy - motions.weight_work(s.masses->heavy(), s.gravity(), parts.x, x) + moved_within;
  if (!(moves_within > may_within)) return true;  // a gain of the motion as a whole alone: the method's own error
  v = rigid + std::sqrt(std::max(may_within, 0.0) / moves_within) * inner;
  return may_within >= 0 || moves_within - may_within <= round_off;
}

template <class Real>
bool limit_energy(Simulation<Real>& s, double h, double time, bool always, Vector& x, Vector& v) {
  ImplicitState<Real>& parts = s.implicit_state();
  Vector start = parts.x;
  if (supports_move(*s.model, s.state.time, time)) {
    if (!always) return false;
    place_supports(*s.model, time, start);
  }
  const auto at_start = parts.body.value(start);  // with the loads of the end: what they do on the way is in it
  if (!at_start && !always) return false;
  const RigidMotions& motions = parts.rigid_motions(*s.model);
  const auto energy_at = [&parts](const Vector& place) {
    const auto energy = parts.body.value(place);
    return energy && std::isfinite(*energy) ? *energy : std::numeric_limits<double>::infinity();
  };
  const double may = at_start.value_or(0) + kinetic_energy(parts, parts.v);
  double has = energy_at(x);
  // Going back does not help where round-off alone is in the way, as in a body at rest.
  const double round_off = round_off_fraction * parts.body.value_round_off();
  Vector places[] = {start, start, start};  // the start moved as a whole to x; slid to x along what it touches there
  if (has > may + round_off && !motions.empty()) {
    Vector contact = Vector::Zero(x.size());
    if (!s.contacts.empty()) parts.body.add_contact(x, contact);
    places[0] = motions.moved(start, x);
    places[1] = motions.slid(start, x, contact);
  }
  for (int k = 0; has > may + round_off && k <= max_halvings; ++k) {
    const Vector& back = places[std::min(3 * k / max_halvings, 2)];
    x = k < max_halvings ? Vector(back + (x - back) / 2) : start;
    v = (x - parts.x) / h;
    has = energy_at(x);
  }
  const double left = std::max(may - has, 0.0);
  if (kinetic_energy(parts, v) > left) slow_down(s, left, x, v);
  return true;
}

template double kinetic_energy(const ImplicitState<float>&, const Vector&);
template double kinetic_energy(const ImplicitState<double>&, const Vector&);
template void slow_down(const Simulation<float>&, double, const Vector&, Vector&);
template void slow_down(const Simulation<double>&, double, const Vector&, Vector&);
template bool take_back_gain(Simulation<float>&, double, double, const Vector&, Vector&);
template bool take_back_gain(Simulation<double>&, double, double, const Vector&, Vector&);
template bool limit_energy(Simulation<float>&, double, double, bool, Vector&, Vector&);
template bool limit_energy(Simulation<double>&, double, double, bool, Vector&, Vector&);

}  // namespace heml
