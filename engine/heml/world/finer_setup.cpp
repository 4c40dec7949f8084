#include <heml/world/finer_setup.hpp>

namespace heml {
namespace {

void take_middles(std::vector<int>& selected, const std::vector<std::array<int, 2>>& ends, std::size_t old_nodes) {
  std::vector<bool> is_selected(old_nodes, false);
  for (const int node : selected) is_selected[static_cast<std::size_t>(node)] = true;
  for (std::size_t m = 0; m < ends.size(); ++m)
    if (is_selected[static_cast<std::size_t>(ends[m][0])] && is_selected[static_cast<std::size_t>(ends[m][1])])
      selected.push_back(static_cast<int>(old_nodes + m));
}

}  // namespace

WorldSetup on_finer_mesh(WorldSetup setup, TetMesh mesh, const std::vector<std::array<int, 2>>& ends) {
  const std::size_t old_nodes = setup.mesh.nodes.size();
  for (Boundary& boundary : setup.boundary) take_middles(boundary.nodes, ends, old_nodes);
  for (Load& load : setup.loads) take_middles(load.nodes, ends, old_nodes);
  std::vector<Vec3>& initial = setup.initial_positions;
  if (!initial.empty())
    for (const auto& [a, b] : ends)
      initial.push_back((initial[static_cast<std::size_t>(a)] + initial[static_cast<std::size_t>(b)]) / 2);
  setup.mesh = std::move(mesh);
  return setup;
}

}  // namespace heml
