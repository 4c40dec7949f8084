#pragma once
// Takes edits of the mesh back while all else stays as it is now.
#include <heml/world/simulation_snapshot.hpp>

namespace heml {

/// Gives mesh, motion, internal state, pins and sutures of before an edit; time, loads and all else stay as they are
/// now. What follows from the set of elements (masses, contact) is left to the caller.
template <class Real>
void restore_before_edit(const SimulationSnapshot<Real>& before, Simulation<Real>& s);

}  // namespace heml
