#pragma once
// Where the solve of an implicit stage begins.
#include <heml/dynamics/implicit_stage.hpp>
#include <heml/world/simulation.hpp>

namespace heml {

/// Moves the coordinates that supports hold to where they are at a time, s. x: 3 #V, m.
template <class Real>
void place_supports(const Model<Real>& model, double time, Vector& x);

/// Of where the body is, x, and where it would fly: the one with the lower Φ (without this guard, methods of few
/// iterations gain energy without bound). Under a budget:
/// - also where free parts would fall as a whole, or along what they would meet: an iteration whose step is cut short
///   elsewhere holds back all of the motion, and momentum is lost;
/// - methods of two stages fly only where that hardly strains the body: an iteration leaves some of that strain, and
///   the next stage starts with a velocity that is off by that over its length. After some stages elements are
///   compressed until the stiffness has negative curvature.
/// Where held nodes move so far that none of them is possible, along the tangent. time: s, at the end of the stage.
template <class Real>
Vector stage_start(Simulation<Real>& s, const Stage& stage, double time, const Vector& x);

/// Lets self-contact know the pairs that touch on the way from the start of the step to where nodes would fall without
/// any force but gravity. Without them a solve goes through what it shall meet, and is made again from there; under a
/// budget it is not, and tissue would pass through tissue. (Elsewhere a solve that goes through costs no more than this
/// search.) x as above.
template <class Real>
void expect_contact(Simulation<Real>& s, const Stage& stage, double time, const Vector& x);

}  // namespace heml
