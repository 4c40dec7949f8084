#include <heml/world/finer_setup.hpp>

namespace heml {
namespace {

void add_midpoints(std::vector<int>& selected, const std::vector<std::array<int, 2>>& midpoint_edges,
                   std::size_t old_nodes) {
  std::vector<bool> is_selected(old_nodes, false);
  for (const int node : selected) is_selected[static_cast<std::size_t>(node)] = true;
  for (std::size_t m = 0; m < midpoint_edges.size(); ++m)
    if (is_selected[static_cast<std::size_t>(midpoint_edges[m][0])] &&
        is_selected[static_cast<std::size_t>(midpoint_edges[m][1])])
      selected.push_back(static_cast<int>(old_nodes + m));
}

}  // namespace

WorldSetup on_finer_mesh(WorldSetup setup, TetMesh mesh, const std::vector<std::array<int, 2>>& midpoint_edges) {
  const std::size_t old_nodes = setup.mesh.nodes.size();
  for (Boundary& boundary : setup.boundary) add_midpoints(boundary.nodes, midpoint_edges, old_nodes);
  for (Load& load : setup.loads) add_midpoints(load.nodes, midpoint_edges, old_nodes);
  std::vector<Vec3>& initial = setup.initial_positions;
  if (!initial.empty())
    for (const auto& [a, b] : midpoint_edges)
      initial.push_back((initial[static_cast<std::size_t>(a)] + initial[static_cast<std::size_t>(b)]) / 2);
  setup.mesh = std::move(mesh);
  return setup;
}

}  // namespace heml
