#include <algorithm>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/improve/surface_tree.hpp>
#include <heml/mesh/mend/clean_triangles.hpp>
#include <heml/mesh/mend/half_edges.hpp>
#include <heml/mesh/merge_nodes.hpp>
#include <limits>
#include <numeric>

namespace heml {
namespace {

constexpr double crack_of_edge = 0.1;
constexpr double junction_of_edge = 2e-3;
constexpr int max_split_rounds = 8;
constexpr std::size_t max_candidates = 20'000'000;  // that a repair looks at; those past it are left as they are

/// A tree of nodes, each a triangle of no extent.
class NodeTree {
 public:
  NodeTree(const TriangleMesh& surface, std::vector<int> nodes) : nodes_(std::move(nodes)), tree_(points(surface)) {}
  /// The nodes in a box, in the order given; none once `max_candidates` were looked at.
  std::vector<int> in(const Eigen::AlignedBox3d& box) {
    std::vector<int> found;
    if (looked_at_ > max_candidates) return found;
    for (const int k : tree_.overlapping(box)) {
      ++looked_at_;
      if (box.contains(tree_.surface().nodes[tree_.surface().triangles[k][0]])) found.push_back(nodes_[k]);
    }
    return found;
  }
  const std::vector<int>& nodes() const { return nodes_; }

 private:
  TriangleMesh points(const TriangleMesh& surface) const {
    TriangleMesh result{surface.nodes, {}, ""};
    for (const int n : nodes_) result.triangles.push_back({n, n, n});
    return result;
  }
  std::vector<int> nodes_;
  SurfaceTree tree_;
  std::size_t looked_at_ = 0;
};

/// Merges every node of the tree with the first kept one within the reach of both.
template <class Within>
int weld(TriangleMesh& surface, NodeTree tree, Within within) {
  std::vector<int> same(surface.nodes.size());
  std::iota(same.begin(), same.end(), 0);
  int welded = 0;
  for (const int n : tree.nodes()) {
    const Vec3& x = surface.nodes[n];
    const Vec3 margin = Vec3::Constant(within(n));
    double nearest = within(n);
    for (const int other : tree.in({x - margin, x + margin})) {
      const double distance = (surface.nodes[other] - x).norm();
      if (other >= n || same[other] != other || distance > std::min(nearest, within(other))) continue;
      if (distance == nearest && same[n] != n) continue;  // the first of two
      nearest = distance;
      same[n] = other;
    }
    welded += same[n] != n;
  }
  if (welded > 0) surface = merge_nodes(surface, same);
  return welded;
}

/// The shortest open edge of each node, m; infinite of nodes without one.
std::vector<double> shortest_open_edges(const TriangleMesh& surface) {
  std::vector<double> shortest(surface.nodes.size(), std::numeric_limits<double>::infinity());
  const HalfEdges edges = find_half_edges(surface);
  for (int half = 0; half < static_cast<int>(edges.across.size()); ++half) {
    if (edges.across[half] != HalfEdges::open) continue;
    const int a = HalfEdges::from(surface, half), b = HalfEdges::to(surface, half);
    const double length = (surface.nodes[a] - surface.nodes[b]).norm();
    for (const int n : {a, b}) shortest[n] = std::min(shortest[n], length);
  }
  return shortest;
}

std::vector<int> nodes_of_open_edges(const std::vector<double>& shortest) {
  std::vector<int> nodes;
  for (std::size_t n = 0; n < shortest.size(); ++n)
    if (shortest[n] < std::numeric_limits<double>::infinity()) nodes.push_back(static_cast<int>(n));
  return nodes;
}

/// The nodes that lie on the edge from a to b, in order from a.
std::vector<int> nodes_on_edge(const TriangleMesh& surface, NodeTree& tree, int a, int b) {
  const Vec3 &from = surface.nodes[a], &to = surface.nodes[b];
  const double length = (to - from).norm(), within = junction_of_edge * length;
  Eigen::AlignedBox3d box(from);
  box.extend(to);
  std::vector<std::pair<double, int>> on;
  for (const int n : tree.in({box.min() - Vec3::Constant(within), box.max() + Vec3::Constant(within)})) {
    const double at = (surface.nodes[n] - from).dot(to - from) / (length * length);
    if (n == a || n == b || at <= junction_of_edge || at >= 1 - junction_of_edge) continue;
    if ((from + at * (to - from) - surface.nodes[n]).norm() <= within) on.push_back({at, n});
  }
  std::sort(on.begin(), on.end());
  std::vector<int> nodes;
  for (const auto& found : on) nodes.push_back(found.second);
  return nodes;
}

/// Splits each triangle at one of its open edges. Returns the number of nodes split at.
int split_round(TriangleMesh& surface) {
  NodeTree tree(surface, nodes_of_open_edges(shortest_open_edges(surface)));
  const HalfEdges edges = find_half_edges(surface);
  int count = 0;
  for (int half = 0; half < static_cast<int>(edges.across.size()); ++half) {
    if (edges.across[half] != HalfEdges::open) continue;
    const Triangle whole = surface.triangles[half / 3];
    const int a = HalfEdges::from(surface, half), b = HalfEdges::to(surface, half);
    const int apex = whole[(half % 3 + 2) % 3];
    std::vector<int> nodes = nodes_on_edge(surface, tree, a, b);
    std::erase(nodes, apex);
    if (nodes.empty()) continue;
    nodes.push_back(b);
    surface.triangles[half / 3] = {a, nodes[0], apex};
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) surface.triangles.push_back({nodes[k], nodes[k + 1], apex});
    count += static_cast<int>(nodes.size()) - 1;
    half = half / 3 * 3 + 2;  // its other edges in the next round
  }
  return count;
}

}  // namespace

int weld_nodes(TriangleMesh& surface, double distance) {
  std::vector<int> all(surface.nodes.size());
  std::iota(all.begin(), all.end(), 0);
  return weld(surface, NodeTree(surface, std::move(all)), [&](int) { return distance; });
}

int weld_cracks(TriangleMesh& surface) {
  const std::vector<double> shortest = shortest_open_edges(surface);
  return weld(surface, NodeTree(surface, nodes_of_open_edges(shortest)),
              [&](int n) { return crack_of_edge * shortest[n]; });
}

int remove_flat_triangles(TriangleMesh& surface) {
  return static_cast<int>(std::erase_if(surface.triangles, [&](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0] ||
           !has_area(surface.nodes[t[0]], surface.nodes[t[1]], surface.nodes[t[2]]);
  }));
}

int remove_duplicate_triangles(TriangleMesh& surface) {
  std::vector<std::pair<Triangle, std::size_t>> sorted;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    sorted.push_back({surface.triangles[t], t});
    std::sort(sorted.back().first.begin(), sorted.back().first.end());
  }
  std::sort(sorted.begin(), sorted.end());
  std::vector<char> is_copy(surface.triangles.size(), 0);
  for (std::size_t k = 1; k < sorted.size(); ++k) is_copy[sorted[k].second] = sorted[k].first == sorted[k - 1].first;
  std::size_t kept = 0;
  for (std::size_t t = 0; t < is_copy.size(); ++t)
    if (!is_copy[t]) surface.triangles[kept++] = surface.triangles[t];
  surface.triangles.resize(kept);
  return static_cast<int>(is_copy.size() - kept);
}

int split_at_nodes(TriangleMesh& surface) {
  int count = 0;
  for (int round = 0; round < max_split_rounds; ++round) {
    const int split = split_round(surface);
    count += split;
    if (split == 0) break;
  }
  return count;
}

}  // namespace heml
