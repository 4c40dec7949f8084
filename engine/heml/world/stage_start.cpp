#include <heml/world/stage_start.hpp>

namespace heml {
namespace {

constexpr double max_strain = 0.16;  // of inertia: what few iterations take out again

/// Where velocities alone take free nodes.
template <class Real>
Vector flight(const Simulation<Real>& s, const Stage& stage, double time, const Vector& x) {
  const Vector fly = stage.y(s.setup->solver.damping);
  Vector result = (s.implicit->mass.array() > 0).select(fly, x);
  place_supports(*s.model, time, result);
  return result;
}

/// Where velocities and gravity alone take free nodes.
template <class Real>
Vector fall(const Simulation<Real>& s, const Stage& stage, double time, const Vector& x) {
  Vector result = flight(s, stage, time, x);
  const Vec3 by_gravity = s.gravity() / stage.a(s.setup->solver.damping);
  for (Eigen::Index i = 0; i < result.size(); ++i)
    if (s.implicit->mass[i] > 0) result[i] += by_gravity[i % 3];
  return result;
}

/// Whether a flight by `way` strains the body so little that its stiffness counts for no more than max_strain beside
/// inertia: from Δ·(aM + K)Δ, which is twice what Φ rises by (`rise`) above its slope −r at the start.
template <class Real>
bool is_gentle(const Simulation<Real>& s, const Stage& stage, const Vector& way, double rise, const Vector& r) {
  const double inertia = stage.a(s.setup->solver.damping) * (s.implicit->mass.array() * way.array().square()).sum();
  return 2 * (rise + r.dot(way)) <= (1 + max_strain) * inertia;
}

/// `stay` with its free parts moved as a whole to where they would fall, or along what they would meet there.
template <class Real>
Vector moved_start(const Simulation<Real>& s, const Vector& stay, const Vector& there) {
  const RigidMotions& motions = s.implicit->rigid_motions(*s.model);
  if (s.contacts.empty()) return motions.moved(stay, there);
  Vector contact = Vector::Zero(there.size());
  s.implicit->body.add_contact(there, contact);
  return motions.slid(stay, there, contact);
}

}  // namespace

template <class Real>
void place_supports(const Model<Real>& model, double time, Vector& x) {
  for (const ConstrainedNode& constrained : model.constrained)
    set_along(constrained.axes, constrained.node, prescribed_at(model, constrained, time).x, x);
}

template <class Real>
Vector stage_start(Simulation<Real>& s, const Stage& stage, double time, const Vector& x) {
  ImplicitState<Real>& parts = s.implicit_state();
  Vector stay = x, r_stay, r_fly, r;
  place_supports(*s.model, time, stay);
  const Vector fly = flight(s, stage, time, x);
  const auto is_defined = [&](const Vector& at, Vector& r_there) {
    return parts.step.residual(at, r_there) && r_there.allFinite();
  };
  const auto staying = parts.step.value(stay), flying = parts.step.value(fly);
  if (staying && flying && s.setup->solver.budget && !parts.rigid_motions(*s.model).empty()) {
    const Vector moved = moved_start(s, stay, fall(s, stage, time, x));
    const auto moving = parts.step.value(moved);
    if (moving && *moving < *staying && *moving < *flying && is_defined(moved, r)) return moved;
  }
  if (staying && flying) {
    const bool must_be_gentle = s.setup->solver.budget && info_of(s.method).stages > 1;
    // The energy of a law that ends at J = 0 is finite again beyond: a flight to there passes what nothing could.
    const bool flies =
        *flying < *staying && !parts.step.inverts_elements(stay, fly) &&
        (!must_be_gentle || !is_defined(stay, r_stay) || is_gentle(s, stage, fly - stay, *flying - *staying, r_stay));
    const Vector &lower = flies ? fly : stay, &higher = flies ? stay : fly;
    if (is_defined(lower, r)) return lower;
    if (is_defined(higher, r)) return higher;
  } else {
    const bool can_stay = is_defined(stay, r_stay), can_fly = is_defined(fly, r_fly);
    if (can_stay && can_fly)
      return r_fly.norm() < r_stay.norm() && !parts.step.inverts_elements(stay, fly) ? fly : stay;
    if (can_stay || can_fly) return can_stay ? stay : fly;
  }
  Vector stretched, d;
  if (!parts.step.residual(x, r)) return stay;
  parts.step.linearise(x);
  parts.step.product(stay - x, stretched);
  r -= stretched;
  return parts.linear.solve(parts.step, r, 1e-2, d) ? Vector(stay + d) : stay;
}

template <class Real>
void expect_contact(Simulation<Real>& s, const Stage& stage, double time, const Vector& x) {
  if (!s.contacts.tissue) return;
  s.implicit->body.expect_contact(fall(s, stage, time, x));
}

template void place_supports(const Model<float>&, double, Vector&);
template void place_supports(const Model<double>&, double, Vector&);
template Vector stage_start(Simulation<float>&, const Stage&, double, const Vector&);
template Vector stage_start(Simulation<double>&, const Stage&, double, const Vector&);
template void expect_contact(Simulation<float>&, const Stage&, double, const Vector&);
template void expect_contact(Simulation<double>&, const Stage&, double, const Vector&);

}  // namespace heml
