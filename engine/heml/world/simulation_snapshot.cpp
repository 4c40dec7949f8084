#include <heml/math/bytes.hpp>
#include <heml/world/simulation_snapshot.hpp>
#include <heml/world/world_queries.hpp>
#include <utility>

namespace heml {
namespace {

WorldSetup without_mesh(WorldSetup& setup) {
  TetMesh mesh = std::exchange(setup.mesh, {});
  MidEdges midedges = std::exchange(setup.midedges, {});
  WorldSetup rest = setup;
  setup.mesh = std::move(mesh);
  setup.midedges = std::move(midedges);
  return rest;
}

template <class Real>
std::shared_ptr<const MeshSnapshot<Real>> mesh_of(Simulation<Real>& s) {
  if (const auto saved = s.saved_mesh.lock(); saved && saved->topology == s.topology) return saved;
  const auto mesh = std::make_shared<const MeshSnapshot<Real>>(
      MeshSnapshot<Real>{s.setup.mesh, s.setup.midedges, s.model, s.topology});
  s.saved_mesh = mesh;
  return mesh;
}

template <class Real>
RecoverySnapshot<Real> snapshot_of(const RecoveryState<Real>& recovery) {
  return {recovery, recovery.surrogate ? std::optional(recovery.surrogate->implicit.snapshot()) : std::nullopt};
}

template <class Real>
void restore(const RecoverySnapshot<Real>& snapshot, Simulation<Real>& s) {
  s.recovery = std::make_unique<RecoveryState<Real>>(s.model, s.mass, snapshot.progress);
  if (!snapshot.surrogate) return;
  s.install_surrogate();
  s.recovery->surrogate->implicit.restore(*snapshot.surrogate);
}

}  // namespace

template <class Real>
SimulationSnapshot<Real> take_snapshot(Simulation<Real>& s) {
  SimulationSnapshot<Real> snapshot;
  snapshot.mesh = mesh_of(s);
  snapshot.setup = without_mesh(s.setup);
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
  s.setup.mesh = snapshot.mesh->mesh;
  s.setup.midedges = snapshot.mesh->midedges;
  s.model = snapshot.mesh->model;
  s.topology = std::make_shared<const Topology>(Topology{s.topology->version + 1, snapshot.mesh->topology->elements});
  static_cast<SimulationState<Real>&>(s) = snapshot.values;
  s.body.restore_all(s.model.mesh, s.model.material_of, snapshot.body, s.state.x.data(), s.model.midedges);
  if (snapshot.implicit) s.implicit_state().restore(*snapshot.implicit);
  if (snapshot.recovery) restore(*snapshot.recovery, s);
}

template <class Real>
std::size_t SimulationSnapshot<Real>::bytes() const {
  std::size_t sum = bytes_of_mesh(mesh->mesh) + bytes_of_model(mesh->model) +
                    bytes_of(mesh->midedges, mesh->topology->elements) + body.bytes() + (values.contacts.tissue ? values.contacts.tissue->bytes() : 0);
  for (const State<Real>* state : {&values.state, &values.last_valid}) sum += bytes_of(state->x, state->v, state->f);
  return sum + bytes_of(values.mass, values.inverse_mass, values.inverse_mass_per_dof);
}

template struct SimulationSnapshot<float>;
template struct SimulationSnapshot<double>;
template SimulationSnapshot<float> take_snapshot(Simulation<float>&);
template SimulationSnapshot<double> take_snapshot(Simulation<double>&);
template void restore(const SimulationSnapshot<float>&, Simulation<float>&);
template void restore(const SimulationSnapshot<double>&, Simulation<double>&);

}  // namespace heml
