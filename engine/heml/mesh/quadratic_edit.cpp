#include <heml/mesh/quadratic_edit.hpp>
#include <map>

namespace heml {
namespace {

using Barycentric = std::array<double, 4>;

/// Where a corner of a piece is in the element that it is a piece of.
Barycentric place_in_parent(int corner, const Tet& parent, const MeshEdit& edit, int old_nodes) {
  const auto local = [&](int n) {
    return static_cast<std::size_t>(std::find(parent.begin(), parent.end(), n) - parent.begin());
  };
  Barycentric place{};
  if (corner < old_nodes) {
    place[local(corner)] = 1;
  } else {
    const InsertedNode& node = edit.nodes[static_cast<std::size_t>(corner - old_nodes)];
    place[local(node.to)] = node.weight;
    place[local(node.from)] = 1 - node.weight;
  }
  return place;
}

/// The nodes that a place in an element follows, ascending: the same from each element that shares the place.
std::vector<NodeShare> shares_at(const Barycentric& place, const std::array<int, 10>& nodes) {
  const std::array<double, 10> N = shape_functions(place);
  std::vector<NodeShare> shares;
  for (std::size_t a = 0; a < 10; ++a)
    if (N[a] != 0) shares.push_back({nodes[a], N[a]});
  std::sort(shares.begin(), shares.end(), [](const NodeShare& a, const NodeShare& b) { return a.node < b.node; });
  return shares;
}

/// The middle of an edge of a new element.
struct Middle {
  int node = -1;                     ///< existing, or to be copied; −1: neither
  std::vector<NodeShare> shares{};  ///< of a place where no node is
};

Middle middle_of(const Barycentric& a, const Barycentric& b, const std::array<int, 10>& parent) {
  Barycentric place;
  for (std::size_t i = 0; i < 4; ++i) place[i] = (a[i] + b[i]) / 2;
  std::vector<NodeShare> shares = shares_at(place, parent);
  if (shares.size() == 1) return {shares.front().node, {}};
  return {-1, std::move(shares)};
}

}  // namespace

void add_midedge_nodes(const TetMesh& mesh, const MidEdges& midedges, MeshEdit& edit) {
  const auto old_nodes = static_cast<int>(mesh.nodes.size());
  std::map<std::pair<int, int>, Middle> middles;  // by the ends of the edge
  const auto edge_of = [](const Tet& tet, const std::array<std::size_t, 2>& local) {
    return std::pair<int, int>(std::minmax(tet[local[0]], tet[local[1]]));
  };
  for (std::size_t k = 0; k < edit.added.size(); ++k) {
    const auto t = static_cast<std::size_t>(edit.parents[k]);
    const std::array<int, 10> parent = quadratic_nodes(mesh.tets[t], midedges[t]);
    std::array<Barycentric, 4> place;
    for (std::size_t c = 0; c < 4; ++c) {
      place[c] = place_in_parent(edit.added[k][c], mesh.tets[t], edit, old_nodes);
      if (edit.added[k][c] < old_nodes) continue;
      InsertedNode& node = edit.nodes[static_cast<std::size_t>(edit.added[k][c] - old_nodes)];
      if (node.from != node.to && node.sum.empty()) node.sum = shares_at(place[c], parent);
    }
    for (const auto& local : tet_edges)
      middles.try_emplace(edge_of(edit.added[k], local), middle_of(place[local[0]], place[local[1]], parent));
  }
  for (auto& [ends, middle] : middles) {
    if (ends.second < old_nodes) continue;  // an edge that there was
    const int from = middle.node < 0 ? middle.shares.front().node : middle.node;
    edit.nodes.push_back({from, from, 0, std::move(middle.shares)});
    middle.node = old_nodes + static_cast<int>(edit.nodes.size()) - 1;
  }
  for (const Tet& tet : edit.added) {
    auto& of_element = edit.midedges.emplace_back();
    for (std::size_t e = 0; e < 6; ++e) of_element[e] = middles.at(edge_of(tet, tet_edges[e])).node;
  }
}

int count_inverted_points(const TetMesh& mesh, const MeshEdit& edit) {
  std::vector<Vec3> nodes = mesh.nodes;
  append(edit, nodes);
  return count_inverted_points(edit.added, edit.midedges,
                               [&](int n) -> const Vec3& { return nodes[static_cast<std::size_t>(n)]; });
}

}  // namespace heml
