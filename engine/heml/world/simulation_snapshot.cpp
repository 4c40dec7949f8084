#include <heml/math/bytes.hpp>
#include <heml/world/simulation_snapshot.hpp>
#include <heml/world/world_queries.hpp>
#include <utility>

namespace heml {
namespace {

template <class Real>
RecoverySnapshot<Real> snapshot_of(const RecoveryState<Real>& recovery) {
  return {recovery, recovery.surrogate ? std::optional(recovery.surrogate->implicit.snapshot()) : std::nullopt};
}

template <class Real>
void restore(const RecoverySnapshot<Real>& snapshot, Simulation<Real>& s) {
  s.recovery = std::make_unique<RecoveryState<Real>>(snapshot.progress);
  if (!snapshot.surrogate) return;
  s.install_surrogate();
  s.recovery->surrogate->implicit.restore(*snapshot.surrogate);
}

}  // namespace

template <class Real>
SimulationSnapshot<Real> take_snapshot(Simulation<Real>& s) {
  SimulationSnapshot<Real> snapshot;
  snapshot.setup = s.setup;
  snapshot.model = s.model;
  snapshot.topology = s.topology;
  snapshot.values = s;
  snapshot.body = s.body.snapshot();
  if (s.implicit) snapshot.implicit = s.implicit->snapshot();
  if (s.recovery) snapshot.recovery = snapshot_of(*s.recovery);
  return snapshot;
}

template <class Real>
void restore(const SimulationSnapshot<Real>& snapshot, Simulation<Real>& s) {
  s.recovery.reset();
  s.implicit.reset();
  s.setup = snapshot.setup;
  s.model = snapshot.model;
  s.topology = std::make_shared<const Topology>(Topology{s.topology->version + 1, snapshot.topology->elements});
  static_cast<SimulationState<Real>&>(s) = snapshot.values;
  s.body.restore_all(snapshot.body, s.state.x.data());
  if (snapshot.implicit) s.implicit_state().restore(*snapshot.implicit);
  if (snapshot.recovery) restore(*snapshot.recovery, s);
}

template <class Real>
std::size_t SimulationSnapshot<Real>::bytes() const {
  std::size_t sum = bytes_of_mesh(setup->mesh) + bytes_of_model(*model);
  sum += bytes_of(setup->midedges, topology->elements) + body.bytes();
  if (values.contacts.tissue) sum += values.contacts.tissue->bytes();
  sum += bytes_of(values.state.x, values.state.v, values.state.f, values.last_valid.x, values.last_valid.v);
  sum += values.frequency_bounds.bytes() + values.damping_bounds.bytes();
  return sum + values.masses->bytes();
}

template struct SimulationSnapshot<float>;
template struct SimulationSnapshot<double>;
template SimulationSnapshot<float> take_snapshot(Simulation<float>&);
template SimulationSnapshot<double> take_snapshot(Simulation<double>&);
template void restore(const SimulationSnapshot<float>&, Simulation<float>&);
template void restore(const SimulationSnapshot<double>&, Simulation<double>&);

}  // namespace heml
