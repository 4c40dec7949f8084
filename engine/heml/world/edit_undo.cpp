#include <algorithm>
#include <heml/world/edit_undo.hpp>
#include <utility>

namespace heml {
namespace {

/// Boundary and loads were set since: they stay, without nodes that the mesh has no more.
template <class Real>
void keep_conditions(Simulation<Real>& s) {
  WorldSetup& setup = s.setup.write();
  const auto nodes = static_cast<int>(setup.mesh.nodes.size());
  const auto trim = [&](auto& entries) {
    for (auto& entry : entries) std::erase_if(entry.nodes, [&](int n) { return n >= nodes; });
  };
  trim(setup.boundary);
  trim(setup.loads);
  set_boundary(setup, s.model.write());
  set_loads(setup, s.model.write());
}

/// Regions were chosen since: the elements that are left keep them. mesh: as it was until now.
template <class Real>
void keep_regions(const TetMesh& mesh, Simulation<Real>& s) {
  WorldSetup& setup = s.setup.write();
  std::copy_n(mesh.regions.begin(), setup.mesh.regions.size(), setup.mesh.regions.begin());
  setup.mesh.region_names = mesh.region_names;
  const auto count = static_cast<int>(setup.mesh.tets.size());
  for (TaggedRegion& region : setup.tagged) std::erase_if(region.tets, [&](int t) { return t >= count; });
  s.update_regions();
}

/// Restores the grasps that have been held ever since, by tools that are where they are now.
template <class Real>
void restore_grasps(const SimulationSnapshot<Real>& before, Simulation<Real>& s) {
  const std::vector<GraspSpring<Real>> now = std::exchange(s.grasps, {});
  for (const auto& grasp : now)
    for (const auto& held : before.values.grasps) {
      if (held.id().serial != grasp.id().serial) continue;
      s.grasps.push_back(held);
      s.grasps.back().hand_over(grasp.id().hand);
      s.grasps.back().move(grasp.target());
    }
}

}  // namespace

template <class Real>
void restore_before_edit(const SimulationSnapshot<Real>& before, Simulation<Real>& s) {
  const SimulationState<Real>& values = before.values;
  WorldSetup& setup = s.setup.write();
  const TetMesh edited = std::exchange(setup.mesh, before.setup->mesh);
  setup.midedges = before.setup->midedges;
  s.model = before.model;
  if (values.condition_changes == s.condition_changes) {
    setup.boundary = before.setup->boundary;
    setup.loads = before.setup->loads;
  } else {
    keep_conditions(s);
  }
  s.topology = std::make_shared<const Topology>(Topology{s.topology->version + 1, before.topology->elements});
  s.state.x = s.last_valid.x = values.state.x;
  s.state.v = s.last_valid.v = values.state.v;
  s.state.f = values.state.f;
  if (s.recovery) s.recovery->last_good = s.state;
  restore_grasps(before, s);
  s.pins = values.pins;
  s.contacts.sutures = values.contacts.sutures;
  s.body.restore(before.body, s.state.x.data());
  if (values.region_changes != s.region_changes) keep_regions(edited, s);
  s.implicit.reset();
}

template void restore_before_edit(const SimulationSnapshot<float>&, Simulation<float>&);
template void restore_before_edit(const SimulationSnapshot<double>&, Simulation<double>&);

}  // namespace heml
