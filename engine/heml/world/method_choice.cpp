// What `"integrator": "auto"` becomes, at the start and from tick to tick, by a fixed model of cost and never by a
// clock, so that a scene gives the same bits on every machine: explicit where that is fast enough, or the given step
// stable; else the accurate implicit method where steps resolve the motion; else the one that damps what they do not. A
// body that is crushed or stretched needs shorter explicit steps: the choice follows it, with a margin so that it does
// not flutter.
//
// What a step costs may be told (SetStepCost): sessions measure it and record what they found as a command.
#include <cmath>
#include <heml/world/step_cost.hpp>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {
constexpr double bound_share = 1.25;  // with the live limit's share
constexpr double enough = 0.6;        // of real time
constexpr double margin = 1.5;        // by which it may be exceeded before a method in use is left
constexpr double resolved = 0.3;      // h ω of a motion that steps of h follow
}  // namespace

template <class Real>
Integrator TypedWorld<Real>::choose_method() {
  const SolverSettings& solver = setup_.solver;
  if (solver.integrator != Integrator::automatic || halt_) return solver.integrator;
  if (explicit_load() <= 1) return Integrator::verlet;
  if (!lowest_frequency_) lowest_frequency_ = lowest_frequency();
  return solver.tick() * *lowest_frequency_ < resolved ? Integrator::tr_bdf2 : Integrator::backward_euler;
}

template <class Real>
MethodFacts TypedWorld<Real>::method_facts() {
  MethodFacts facts;
  facts.asked = setup_.solver.integrator;
  facts.used = method_;
  facts.step_cost = step_cost();
  facts.explicit_share = explicit_share();
  facts.enough = enough;
  if (!is_explicit(method_) && !implicit_ && !halt_) lowest_frequency_ = lowest_frequency();
  facts.lowest_frequency = lowest_frequency_;
  facts.resolved = resolved;
  return facts;
}

/// At the start of a tick.
template <class Real>
void TypedWorld<Real>::reconsider_method() {
  find_stable_step();
  const bool keep = is_explicit(method_) ? explicit_load() <= margin : explicit_load() > 1 / margin;
  if (keep) return;
  method_ = choose_method();
  if (implicit_) implicit_->h_before = 0;  // BDF2 starts anew
}

/// What an explicit method asks for now, 1 being the most it may: of the time there is, or, where a step is given, of
/// the stable one.
template <class Real>
double TypedWorld<Real>::explicit_load() const {
  const SolverSettings& solver = setup_.solver;
  return solver.step ? *solver.step / stable_step_ : explicit_share() / enough;
}

template <class Real>
double TypedWorld<Real>::explicit_share() const {
  return bound_share * step_cost() * static_cast<double>(model_.mesh.tets.size()) / stable_step_;
}

template <class Real>
double TypedWorld<Real>::step_cost() const {
  return told_step_cost_.value_or(fixed_step_cost(body_.kernels(), setup_));
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetStepCost& command) {
  if (!(command.nanoseconds > 0) || !std::isfinite(command.nanoseconds))
    return "step_cost: must be more than 0 ns an element";
  told_step_cost_ = 1e-9 * command.nanoseconds;
  return std::nullopt;
}

/// Rayleigh's quotient of how the body gives way at rest to a field of gravity along each axis, 1/s; 0 where it is
/// free.
template <class Real>
double TypedWorld<Real>::lowest_frequency() {
  ImplicitState<Real>& parts = implicit();
  if (parts.free.node.empty() || !is_well_constrained(model_.mesh, constrained_nodes())) return 0;
  Vector rest(parts.mass.size()), shape, push;
  for (std::size_t n = 0; n < model_.mesh.nodes.size(); ++n)
    rest.template segment<3>(3 * static_cast<int>(n)) = model_.mesh.nodes[n];
  double least = 0;
  parts.body.linearise(rest);
  for (int axis = 0; axis < 3; ++axis) {
    Vector weight = Vector::Zero(parts.mass.size());
    for (Eigen::Index n = 0; n < weight.size() / 3; ++n) weight[3 * n + axis] = parts.mass[3 * n + axis];
    parts.linear.set_inertia(0);
    if (!parts.linear.solve(parts.body, weight, 1e-2, shape)) return 0;
    const double square = shape.dot(weight) / (parts.mass.array() * shape.array().square()).sum();
    if (axis == 0 || square < least) least = square;
  }
  return std::sqrt(least);
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
