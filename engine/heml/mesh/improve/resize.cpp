#include <algorithm>
#include <heml/mesh/improve/collapse_edge.hpp>
#include <heml/mesh/improve/resize.hpp>
#include <heml/mesh/improve/smooth_node.hpp>
#include <heml/mesh/improve/split_edge.hpp>
#include <tuple>

namespace heml {
namespace {

constexpr int max_passes = 60;

struct LongEdge {
  double length;
  int a, b;
  bool operator<(const LongEdge& other) const {
    return std::tie(length, a, b) < std::tie(other.length, other.a, other.b);
  }
};

double length_of(const LocalMesh& mesh, int a, int b) { return (mesh.node(a) - mesh.node(b)).norm(); }

/// Every edge once, short ones first.
std::vector<LongEdge> edges_by_length(const LocalMesh& mesh) {
  std::vector<LongEdge> edges;
  for (int n = 0; n < mesh.nodes(); ++n) {
    std::vector<int> neighbours;
    for (const int t : mesh.star(n))
      for (const int other : mesh.tet(t))
        if (other > n) neighbours.push_back(other);
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    for (const int other : neighbours) edges.push_back({length_of(mesh, n, other), n, other});
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

bool collapse_either_way(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b, double quality) {
  if (mesh.is_on_surface(a) && !mesh.is_on_surface(b)) std::swap(a, b);
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
    if (collapse_edge(mesh, guard, from, to, std::min(quality, mesh.worst(mesh.star(from))))) return true;
  return false;
}

bool is_longest_round(const LocalMesh& mesh, const LongEdge& edge) {
  for (const int t : mesh.star(edge.a)) {
    const Tet& tet = mesh.tet(t);
    if (std::find(tet.begin(), tet.end(), edge.b) == tet.end()) continue;
    for (const auto& [i, j] : tet_edges) {
      const auto [low, high] = std::minmax(tet[i], tet[j]);
      if (edge < LongEdge{length_of(mesh, low, high), low, high}) return false;
    }
  }
  return true;
}

/// Marks a node and its neighbours.
void mark_round(const LocalMesh& mesh, int n, std::vector<char>& touched) {
  for (const int t : mesh.star(n))
    for (const int other : mesh.tet(t)) touched[other] = 1;
}

}  // namespace

void coarsen(LocalMesh& mesh, const SurfaceGuard& guard, int tets, double quality) {
  for (int pass = 0; pass < max_passes && mesh.count() > tets; ++pass) {
    const auto edges = edges_by_length(mesh);
    std::vector<char> touched(mesh.nodes(), 0);
    int done = 0;
    for (const LongEdge& edge : edges) {
      if (mesh.count() <= tets) break;
      if (touched[edge.a] || touched[edge.b]) continue;
      if (!collapse_either_way(mesh, guard, edge.a, edge.b, quality)) continue;
      mark_round(mesh, mesh.star(edge.a).empty() ? edge.b : edge.a, touched);
      ++done;
    }
    for (int n = 0; n < mesh.nodes(); ++n)
      if (touched[n] && !mesh.star(n).empty()) smooth_node(mesh, guard, n);
    if (done == 0) break;
  }
}

void refine_longest(LocalMesh& mesh, int tets) {
  for (int pass = 0; pass < max_passes && mesh.count() < tets; ++pass) {
    const auto edges = edges_by_length(mesh);
    for (auto edge = edges.rbegin(); edge != edges.rend() && mesh.count() < tets; ++edge)
      if (is_longest_round(mesh, *edge)) split_edge(mesh, edge->a, edge->b);
  }
}

}  // namespace heml
