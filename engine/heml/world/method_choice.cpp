#include <cmath>
#include <heml/world/method_choice.hpp>
#include <heml/world/stable_step.hpp>
#include <heml/world/step_cost.hpp>

namespace heml {
namespace {
constexpr double bound_share = 1.25;     // with the live limit's share
constexpr double real_time_share = 0.6;  // of real time
constexpr double margin = 1.5;           // by which it may be exceeded before a method in use is left
constexpr double resolved = 0.3;         // h ω of a motion that steps of h follow
}  // namespace

template <class Real>
Integrator MethodChoice<Real>::chosen() {
  const SolverSettings& solver = s_.setup->solver;
  if (solver.integrator != Integrator::automatic || s_.halt) return solver.integrator;
  if (explicit_load() <= 1) return Integrator::verlet;
  if (!s_.lowest_frequency) s_.lowest_frequency = lowest_frequency();
  return solver.tick() * *s_.lowest_frequency < resolved ? Integrator::tr_bdf2 : Integrator::backward_euler;
}

template <class Real>
MethodFacts MethodChoice<Real>::facts() {
  MethodFacts facts;
  facts.asked = s_.setup->solver.integrator;
  facts.used = s_.method;
  facts.step_cost = step_cost();
  facts.explicit_share = explicit_share();
  facts.enough = real_time_share;
  if (!is_explicit(s_.method) && !s_.implicit && !s_.halt) s_.lowest_frequency = lowest_frequency();
  facts.lowest_frequency = s_.lowest_frequency;
  facts.resolved = resolved;
  return facts;
}

template <class Real>
void MethodChoice<Real>::choose() {
  s_.method = chosen();
}

template <class Real>
void MethodChoice<Real>::reconsider() {
  if (s_.setup->solver.integrator != Integrator::automatic) return;
  find_stable_step(s_);
  const bool keep = is_explicit(s_.method) ? explicit_load() <= margin : explicit_load() > 1 / margin;
  if (keep) return;
  choose();
  if (s_.implicit) s_.implicit->h_before = 0;  // BDF2 starts anew
}

/// What an explicit method asks for now, 1 being the most it may: of the time there is, or, where a step is given, of
/// the stable one.
template <class Real>
double MethodChoice<Real>::explicit_load() const {
  const SolverSettings& solver = s_.setup->solver;
  return solver.step ? *solver.step / s_.limit.stable : explicit_share() / real_time_share;
}

template <class Real>
double MethodChoice<Real>::explicit_share() const {
  return bound_share * step_cost() * static_cast<double>(s_.model->mesh.tets.size()) / s_.limit.stable;
}

template <class Real>
double MethodChoice<Real>::step_cost() const {
  return s_.step_cost.value_or(fixed_step_cost(s_.body.kernels(), *s_.setup));
}

/// Rayleigh's quotient of how the body gives way at rest to a field of gravity along each axis, 1/s; 0 where it is
/// free.
template <class Real>
double MethodChoice<Real>::lowest_frequency() {
  ImplicitState<Real>& parts = s_.implicit_state();
  if (parts.free.node.empty() || !is_well_constrained(*s_.model, s_.constrained_nodes())) return 0;
  Vector rest(parts.mass.size()), shape, push;
  for (std::size_t n = 0; n < s_.model->mesh.nodes.size(); ++n)
    rest.template segment<3>(3 * static_cast<int>(n)) = s_.model->mesh.nodes[n];
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

template class MethodChoice<float>;
template class MethodChoice<double>;

}  // namespace heml
