// What `"integrator": "auto"` becomes, by a fixed model of cost and never by a clock, so that a scene gives the same
// bits on every machine: explicit where that is fast enough, or the given step stable; else the accurate implicit
// method where steps resolve the motion; else the one that damps what they do not.
#include <cmath>
#include <heml/world/typed_world.hpp>

namespace heml {
namespace {
constexpr double seconds_an_element = 40e-9;  // of an explicit step, one core (measured: 1,600 to 12,800 elements)
constexpr double bound_share = 1.25;          // with the live limit's share
constexpr double enough = 0.6;                // of real time
constexpr double resolved = 0.3;              // h ω of a motion that steps of h follow
}  // namespace

template <class Real>
Integrator TypedWorld<Real>::choose_method() {
  const SolverSettings& solver = setup_.solver;
  if (solver.integrator != Integrator::automatic || halt_) return solver.integrator;
  const double cost = bound_share * seconds_an_element * static_cast<double>(model_.mesh.tets.size());  // s
  const bool is_explicit_best = solver.step ? *solver.step <= stable_step_ : cost / stable_step_ <= enough;
  if (is_explicit_best) return Integrator::verlet;
  return solver.tick() * lowest_frequency() < resolved ? Integrator::tr_bdf2 : Integrator::backward_euler;
}

/// Rayleigh's quotient of how the body gives way at rest to a field of gravity along each axis, 1/s; 0 where it is
/// free.
template <class Real>
double TypedWorld<Real>::lowest_frequency() {
  ImplicitParts<Real>& parts = implicit();
  if (parts.free.node.empty() || !well_held(model_.mesh, model_.held)) return 0;
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
