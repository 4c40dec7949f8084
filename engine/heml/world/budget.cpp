// Implicit steps that must be on time: their stages end after a number of iterations, wherever they are. A lower Φ does
// not bound the energy, so what was cut short is looked at once more.
#include <algorithm>
#include <cmath>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {
// Of an iteration, a tetrahedron, one core: the stiffness, a dozen products and back-solves, two forces and values. For
// budgets in milliseconds where no clock may be asked; a session measures (session/budget_controller.hpp).
constexpr double seconds_an_iteration = 0.7e-6;
constexpr int max_iterations = 60, max_halvings = 40;
}  // namespace

template <class Real>
int TypedWorld<Real>::stage_iterations() const {
  const Budget& budget = *setup_.solver.budget;
  if (budget.iterations > 0) return budget.iterations;
  const double stages = method_ == Integrator::tr_bdf2 ? 2 : 1;
  const double cost = seconds_an_iteration * static_cast<double>(model_.mesh.tets.size());
  return std::clamp(static_cast<int>(budget.milliseconds / 1000 / (stages * cost)), 1, max_iterations);
}

/// Takes from x, v what energy a step has gained beyond the work of its loads: from the velocity while that has it to
/// give, else by going back towards the start. Held nodes that move do work of their own, and pressure that follows the
/// surface has no potential: nothing is known there, and nothing done.
template <class Real>
void TypedWorld<Real>::limit_energy(double h, double time, Vector& x, Vector& v) {
  ImplicitState<Real>& parts = implicit();
  for (const ConstrainedNode& constrained : model_.constrained)
    if (prescribed_at(model_, constrained, time).x != prescribed_at(model_, constrained, state_.time).x) return;
  const auto kinetic = [&](const Vector& velocity) {
    return (parts.mass.array() * velocity.array().square()).sum() / 2;
  };
  const auto at_start = parts.body.value(parts.x);  // with the loads of the end: what they do on the way is in it
  if (!at_start) return;
  const double may = *at_start + kinetic(parts.v);
  double has = *parts.body.value(x);
  for (int k = 0; has > may && k <= max_halvings; ++k) {
    x = k < max_halvings ? Vector(parts.x + (x - parts.x) / 2) : parts.x;
    v = (x - parts.x) / h;
    has = *parts.body.value(x);
  }
  const double moving = kinetic(v), left = std::max(may - has, 0.0);
  if (moving > left) v *= std::sqrt(left / moving);
  Vector r;
  parts.step.residual(x, r);  // forces are taken from what the objective saw last
  work_.residual = parts.body.relative_residual(r);
}

template <class Real>
std::optional<std::string> TypedWorld<Real>::execute(const SetBudget& command) {
  if (command.iterations < 1) return "budget: needs one iteration or more";
  if (!setup_.solver.budget) setup_.solver.budget.emplace();
  setup_.solver.budget->iterations = command.iterations;
  return std::nullopt;
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
