// Static worlds: the body is at rest at every fraction of its load (dynamics/static_solve.hpp).
#include <fmt/format.h>

#include <algorithm>
#include <heml/world/typed_world.hpp>
#include <limits>

namespace heml {
namespace {
// Of the highest ω²: what holds a body that nothing else holds, while it is solved; and what stands for it in float.
constexpr double anchor = 1e-9, anchor_in_float = 1e-6;

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
void TypedWorld<Real>::load_to(double fraction) {
  if (halt_) return;
  ++changes_;
  const FlushDenormals flush;
  ImplicitState<Real>& parts = implicit();
  const double duration = setup_.solver.load_duration();
  if (remembers_) body_.begin_step(std::numeric_limits<Real>::infinity());  // at rest for long: all has relaxed
  const auto size = static_cast<Eigen::Index>(state_.x.size());
  const Vector start =
      Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, 1>>(state_.x.data(), size).template cast<double>();
  parts.body.begin_static(duration, setup_.gravity, start);
  if (!parts.equilibrium) {
    const double highest = static_cast<double>(rest_frequency_ * rest_frequency_);
    const bool constrained = is_well_constrained(model_.mesh, constrained_nodes());
    if (!constrained) parts.body.set_regularisation(anchor * highest);
    const StaticTolerance limit{setup_.solver.relative_tolerance(), setup_.solver.tolerance.has_value()};
    parts.equilibrium.emplace(parts.body, parts.linear, parts.mass, parts.free, limit,
                              constrained ? 0 : anchor_in_float * highest, start);
  }
  StaticSolve& equilibrium = *parts.equilibrium;
  work_.load = equilibrium.load();
  if (constrained_nodes().empty() && !contacts_.has_tools() && pushed_away(parts.body, equilibrium.x(), fraction))
    return halt_unsolved(
        {StopReason::Cause::not_converged, -1, -1,
         "no equilibrium: nothing holds the body and its loads do not balance (add a boundary entry)"});
  const bool reached = equilibrium.load_to(fraction, interrupted_);
  work_.load = equilibrium.load();
  work_.iterations = equilibrium.iterations();
  work_.residual = equilibrium.relative_residual();
  steps_ = equilibrium.increments();
  parts.body.set_load(equilibrium.load());
  Vector r;
  parts.body.residual(equilibrium.x(), r);
  set_state(equilibrium.x(), Vector::Zero(equilibrium.x().size()), equilibrium.load() * duration);
  if (!reached && !interrupted_) halt_unsolved(why_not_beyond(equilibrium));
}

template <class Real>
StopReason TypedWorld<Real>::why_not_beyond(const StaticSolve& equilibrium) const {
  const double load = equilibrium.load();
  StopReason halt{StopReason::Cause::not_converged, -1, -1, {}};
  if (equilibrium.round_off()) {
    halt.message = fmt::format(
        "no equilibrium to within {:.1e} of the forces beyond {:.4g} of the load: round-off leaves {:.1e} of them "
        "({}): "
        "what is written is the last one",
        setup_.solver.relative_tolerance(), load, *equilibrium.round_off(),
        single_ ? "solve with \"precision\": \"double\"" : "allow a larger \"tolerance\"");
    return halt;
  }
  if (implicit_->free.node.empty()) {  // supports alone say where everything is
    std::vector<Real> x;
    for (const double value : equilibrium.tried()) x.push_back(static_cast<Real>(value));
    const int element = first_flat(x);
    if (element >= 0) {
      halt.cause = StopReason::Cause::out_of_range;
      halt.element = model_.order.file_tet[static_cast<std::size_t>(element)];
      halt.message = fmt::format(
          "no equilibrium beyond {:.4g} of the load: the supports, which hold every node, press element {} flat, turn "
          "it inside out or out of the range of its law (move them less): what is written is the last one",
          load, halt.element);
      return halt;
    }
  }
  halt.message =
      fmt::format("no equilibrium found beyond {:.4g} of the load ({}): what is written is the last one", load,
                  is_well_constrained(model_.mesh, constrained_nodes())
                      ? "the body may snap, collapse or be crushed there, or leave the range of its law"
                      : "its constraints leave a rigid motion free: then loads must balance, in force and moment");
  return halt;
}

/// The first element out of its law's range or inside out at positions, 3 #V; inner number, −1: none.
template <class Real>
int TypedWorld<Real>::first_flat(const std::vector<Real>& x) const {
  const int invalid = body_.first_undefined(x.data());
  if (invalid >= 0) return invalid;
  const auto at = [&](int n) {
    return Vec3(Eigen::Map<const Vector3<Real>>(&x[3 * static_cast<std::size_t>(n)]).template cast<double>());
  };
  const auto& tets = model_.mesh.tets;
  const auto flat = std::find_if(tets.begin(), tets.end(), [&](const Tet& tet) {
    return !(signed_volume(at(tet[0]), at(tet[1]), at(tet[2]), at(tet[3])) > 0);
  });
  return flat == tets.end() ? -1 : static_cast<int>(flat - tets.begin());
}

template class TypedWorld<float>;
template class TypedWorld<double>;

}  // namespace heml
