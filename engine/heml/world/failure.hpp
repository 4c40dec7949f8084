#pragma once
// Why a step failed, in words, and the way back to the last valid state.
#include <heml/world/simulation.hpp>

namespace heml {

/// Names the first element whose law is undefined at x. x: 3 #V, m; time: s.
template <class Real>
StopReason out_of_range(const Simulation<Real>& s, const std::vector<Real>& x, double time);

/// Restores s.last_valid and its forces. Returns the reason, which names the element or node of the failed state.
template <class Real>
[[nodiscard]] StopReason restore_last_valid(Simulation<Real>& s, StopReason::Cause cause);

/// Restores the forces of the state that the last successful step left. Returns `reason`.
template <class Real>
[[nodiscard]] StopReason keep_last_solved(Simulation<Real>& s, const StopReason& reason);

}  // namespace heml
