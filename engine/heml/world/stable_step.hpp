#pragma once
// The stable step of explicit methods, from the live frequency bound of the elements (elastic/step_bound.hpp):
// h with h²λ + 2h c < 4, λ the elastic bound plus the ω² of a grasp, c the damping that lags half a step.
#include <heml/world/simulation.hpp>

namespace heml {

inline constexpr double min_step = 1e-9;  ///< s; a body that needs shorter steps is not soft tissue

/// Evaluates the bound at the current state and sets limit.stable.
template <class Real>
void find_stable_step(Simulation<Real>& s);

/// The same, and sets the interval to the next evaluation by how fast the bound changes.
template <class Real>
void update_stable_step(Simulation<Real>& s);

/// Has the bound evaluated before the next step.
template <class Real>
void need_stable_step(Simulation<Real>& s);

/// Steps in which the fastest hand or prescribed motion strains the elements next to it by as much as the bound may
/// change between two evaluations.
template <class Real>
int steps_until_strained(const Simulation<Real>& s);

inline constexpr int steps_between_bounds_when_driven = 2;  ///< by a probe, say, which deforms it quickly

}  // namespace heml
