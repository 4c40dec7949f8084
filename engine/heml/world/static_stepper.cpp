#include <fmt/format.h>

#include <algorithm>
#include <heml/world/failure.hpp>
#include <heml/world/static_stepper.hpp>
#include <limits>

namespace heml {
namespace {
// Of the highest ω²: what holds a body that nothing else holds, while it is solved; and what stands for it in float.
constexpr double anchor = 1e-9, anchor_in_float = 1e-6;
constexpr double limit_ratio = 0.02;           // of the stiffness at rest: less is that of a limit point
constexpr std::size_t max_limit_nodes = 5000;  // free nodes of bodies whose limit point is looked for

/// Whether the loads on a body that nothing holds have a sum. x: positions, 3 #V.
template <class Real>
bool pushed_away(BodyObjective<Real>& body, const Vector& x, double fraction) {
  Vector r;
  body.set_load(fraction);
  body.residual(x, r);
  return body.relative_net_load() > 1e-6;
}
}  // namespace

template <class Real>
std::optional<StopReason> StaticStepper<Real>::load_to(double fraction) {
  ++s_.changes;
  const FlushDenormals flush;
  ImplicitState<Real>& parts = s_.implicit_state();
  const double duration = s_.setup->solver.load_duration();
  if (s_.has_internal_state)
    s_.body.begin_step(std::numeric_limits<Real>::infinity());  // at rest for long: all has relaxed
  const auto size = static_cast<Eigen::Index>(s_.state.x.size());
  const Vector start =
      Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, 1>>(s_.state.x.data(), size).template cast<double>();
  parts.body.begin_static(duration, s_.setup->gravity, start);
  if (!parts.equilibrium) {
    const double highest = static_cast<double>(s_.rest_frequency * s_.rest_frequency);
    const bool constrained = is_well_constrained(*s_.model, s_.constrained_nodes());
    if (!constrained) parts.body.set_regularisation(anchor * highest);
    const StaticTolerance limit{s_.setup->solver.relative_tolerance(), s_.setup->solver.tolerance.has_value()};
    parts.equilibrium.emplace(parts.body, parts.linear, parts.mass, parts.free, limit,
                              constrained ? 0 : anchor_in_float * highest, start);
  }
  StaticSolve& equilibrium = *parts.equilibrium;
  s_.stats.load = equilibrium.load();
  if (s_.constrained_nodes().empty() && !s_.contacts.has_tools() && pushed_away(parts.body, equilibrium.x(), fraction))
    return keep_last_solved(
        s_, {StopReason::Cause::not_converged, -1, -1,
             "no equilibrium: nothing holds the body and its loads do not balance (add a boundary entry)"});
  const bool reached = equilibrium.load_to(fraction, s_.interrupted);
  s_.stats.limit_stiffness.reset();
  if (!reached && !s_.interrupted && !equilibrium.round_off() && !parts.free.node.empty() &&
      parts.free.node.size() <= max_limit_nodes)
    s_.stats.limit_stiffness = equilibrium.approach_limit(rest_positions(), s_.interrupted);
  s_.stats.load = equilibrium.load();
  s_.stats.iterations = equilibrium.iterations();
  s_.stats.residual = equilibrium.relative_residual();
  s_.steps = equilibrium.increments();
  parts.body.set_load(equilibrium.load());
  Vector r;
  parts.body.residual(equilibrium.x(), r);
  s_.set_state(equilibrium.x(), Vector::Zero(equilibrium.x().size()), equilibrium.load() * duration);
  if (!reached && !s_.interrupted) return keep_last_solved(s_, why_not_beyond(equilibrium));
  return std::nullopt;
}

template <class Real>
Vector StaticStepper<Real>::rest_positions() const {
  Vector rest(3 * static_cast<Eigen::Index>(s_.model->mesh.nodes.size()));
  for (std::size_t n = 0; n < s_.model->mesh.nodes.size(); ++n)
    rest.segment<3>(3 * static_cast<int>(n)) = s_.model->mesh.nodes[n];
  return rest;
}

template <class Real>
StopReason StaticStepper<Real>::why_not_beyond(const StaticSolve& equilibrium) const {
  const double load = equilibrium.load();
  StopReason halt{StopReason::Cause::not_converged, -1, -1, {}};
  if (equilibrium.round_off()) {
    halt.message = fmt::format(
        "no equilibrium to within {:.1e} of the forces beyond {:.4g} of the load: round-off leaves {:.1e} of them "
        "({}): "
        "what is written is the last one",
        s_.setup->solver.relative_tolerance(), load, *equilibrium.round_off(),
        sizeof(Real) == sizeof(float) ? "solve with \"precision\": \"double\"" : "allow a larger \"tolerance\"");
    return halt;
  }
  if (s_.implicit->free.node.empty()) {  // supports alone say where everything is
    std::vector<Real> x;
    for (const double value : equilibrium.initial_guess()) x.push_back(static_cast<Real>(value));
    const int element = first_flat(x);
    if (element >= 0) {
      halt.cause = StopReason::Cause::out_of_range;
      halt.element = s_.model->order.file_tet[static_cast<std::size_t>(element)];
      halt.message = fmt::format(
          "no equilibrium beyond {:.4g} of the load: the supports, which hold every node, press element {} flat, turn "
          "it inside out or out of the range of its law (move them less): what is written is the last one",
          load, halt.element);
      return halt;
    }
  }
  if (s_.stats.limit_stiffness && *s_.stats.limit_stiffness <= limit_ratio) {
    halt.message = fmt::format(
        "no equilibrium beyond {:.6g} of the load, a limit point: the stiffness of the body falls to {:.1e} of that at "
        "rest there: what is written is the last one",
        load, *s_.stats.limit_stiffness);
    return halt;
  }
  halt.message =
      fmt::format("no equilibrium found beyond {:.4g} of the load ({}): what is written is the last one", load,
                  is_well_constrained(*s_.model, s_.constrained_nodes())
                      ? "the body may snap, collapse or be crushed there, or leave the range of its law"
                      : "its constraints leave a rigid motion free: then loads must balance, in force and moment");
  return halt;
}

/// The first element out of its law's range or inside out at positions, 3 #V; inner number, −1: none.
template <class Real>
int StaticStepper<Real>::first_flat(const std::vector<Real>& x) const {
  const int invalid = s_.body.first_undefined(x.data());
  if (invalid >= 0) return invalid;
  const auto at = [&](int n) {
    return Vec3(Eigen::Map<const Vector3<Real>>(&x[3 * static_cast<std::size_t>(n)]).template cast<double>());
  };
  const auto& tets = s_.model->mesh.tets;
  for (std::size_t t = 0; t < s_.model->midedges.size(); ++t)
    if (count_inverted_points({tets[t]}, {s_.model->midedges[t]}, at) > 0) return static_cast<int>(t);
  if (!s_.model->midedges.empty()) return -1;
  const auto flat = std::find_if(tets.begin(), tets.end(), [&](const Tet& tet) {
    return !(signed_volume(at(tet[0]), at(tet[1]), at(tet[2]), at(tet[3])) > 0);
  });
  return flat == tets.end() ? -1 : static_cast<int>(flat - tets.begin());
}

template class StaticStepper<float>;
template class StaticStepper<double>;

}  // namespace heml
