#pragma once
// A simulation's data at one moment. Undo keeps one per edit, World::snapshot() adds what the phases remember.
//
//   values      copied whole: SimulationState
//   setup, model, topology    shared with the simulation until it is edited
//   body        elements (shared), internal state of every term
//   implicit    the step before, contact's friction, factors' inertia; matrices are made anew
//   recovery    the last good state, and the surrogate's implicit part; the surrogate itself is made anew
#include <heml/world/simulation.hpp>

namespace heml {

template <class Real>
struct SimulationSnapshot {
  Shared<WorldSetup> setup;
  Shared<Model<Real>> model;
  std::shared_ptr<const Topology> topology;
  SimulationState<Real> values;
  BodySnapshot<Real> body;
  std::optional<ImplicitSnapshot<Real>> implicit;
  std::optional<RecoverySnapshot<Real>> recovery;

  std::size_t bytes() const;
};

template <class Real>
SimulationSnapshot<Real> take_snapshot(Simulation<Real>& s);

/// Restores everything, into the simulation of the snapshot or one of the same body. The topology gets a new version.
template <class Real>
void restore(const SimulationSnapshot<Real>& snapshot, Simulation<Real>& s);

}  // namespace heml
