#pragma once
// How stiff a grasp is.
#include <heml/world/simulation.hpp>

namespace heml {

/// ω of a grasp, 1/s: about as stiff as the patch of tissue it holds, whose own frequency is √(μ/ρ)/radius, and never
/// so stiff that it shortens the step much. The patch: center, and those of nodes within radius (m) of it at rest;
/// inner numbers. Of several tissues round the patch the stiffest counts.
template <class Real>
double grasp_frequency(const Simulation<Real>& s, int center, double radius, const std::vector<int>& nodes);

}  // namespace heml
