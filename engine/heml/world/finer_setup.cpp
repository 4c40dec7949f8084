#include <algorithm>
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

WorldSetup with_midedges(WorldSetup setup) {
  TetMesh mesh = setup.mesh;
  const std::size_t corners = mesh.nodes.size();
  MidEdges midedges = add_midedge_nodes(mesh);
  std::vector<std::array<int, 2>> edges(mesh.nodes.size() - corners);
  for (std::size_t t = 0; t < midedges.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e)
      edges[static_cast<std::size_t>(midedges[t][e]) - corners] = {mesh.tets[t][tet_edges[e][0]],
                                                                   mesh.tets[t][tet_edges[e][1]]};
  setup = on_finer_mesh(std::move(setup), std::move(mesh), edges);
  setup.midedges = std::move(midedges);
  return setup;
}

bool has_straight_edges(const WorldSetup& setup) {
  if (setup.midedges.empty()) return true;
  TetMesh corners = setup.mesh;
  corners.nodes.resize(setup.mesh.nodes.size() - count_nodes(setup.midedges));
  const auto is_corner = [&](int n) { return static_cast<std::size_t>(n) < corners.nodes.size(); };
  for (const Tet& tet : corners.tets)
    if (!std::all_of(tet.begin(), tet.end(), is_corner)) return false;
  return add_midedge_nodes(corners) == setup.midedges && corners.nodes == setup.mesh.nodes;
}

WorldSetup corners_of(WorldSetup setup) {
  const std::size_t corners = setup.mesh.nodes.size() - count_nodes(setup.midedges);
  const auto keep_corners = [&](std::vector<int>& nodes) {
    std::erase_if(nodes, [&](int n) { return static_cast<std::size_t>(n) >= corners; });
  };
  for (Boundary& boundary : setup.boundary) keep_corners(boundary.nodes);
  for (Load& load : setup.loads) keep_corners(load.nodes);
  setup.mesh.nodes.resize(corners);
  if (!setup.initial_positions.empty()) setup.initial_positions.resize(corners);
  setup.midedges.clear();
  return setup;
}

}  // namespace heml
