#pragma once
// Boundary entries and loads of a running world.
#include <heml/world/simulation.hpp>

namespace heml {

/// Takes the entries in place of those present. Ramps start now; an entry that is one of those present, on all its
/// nodes or on some, goes on with its ramp. Returns what is wrong with the entries: then nothing changes.
template <class Real>
Status replace_boundary(Simulation<Real>& s, std::vector<Boundary> entries);
template <class Real>
Status replace_loads(Simulation<Real>& s, std::vector<Load> entries);

/// All ramps start at t = 0.
template <class Real>
void restart_ramps(Simulation<Real>& s);

}  // namespace heml
