#include <algorithm>
#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/refine.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <tuple>

namespace heml {
namespace {

using Edge = std::array<int, 2>;  // nodes, ascending

Edge edge_of(const Tet& tet, std::size_t e) {
  const int a = tet[tet_edges[e][0]], b = tet[tet_edges[e][1]];
  return {std::min(a, b), std::max(a, b)};
}

class Bisection {
 public:
  explicit Bisection(const TetMesh& mesh) : mesh_(mesh) {
    result_.mesh.nodes = mesh.nodes;
    result_.mesh.source = mesh.source;
  }

  void mark(const std::vector<int>& chosen) {
    for (const int t : chosen) mark_longest(mesh_.tets[static_cast<std::size_t>(t)]);
    for (std::size_t before = 0; before != midpoints_.size();) {
      before = midpoints_.size();
      for (const Tet& tet : mesh_.tets)
        if (longest_marked(tet)) mark_longest(tet);
    }
  }

  Refinement cut() {
    number_midpoints();
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) cut(mesh_.tets[t], static_cast<int>(t));
    inherit_fields();
    return std::move(result_);
  }

 private:
  /// Whether edge a precedes b: the longer one, or among equal lengths the one with lower node numbers.
  bool is_longer(const Edge& a, const Edge& b) const {
    const auto length = [&](const Edge& e) {
      return (mesh_.nodes[static_cast<std::size_t>(e[0])] - mesh_.nodes[static_cast<std::size_t>(e[1])]).squaredNorm();
    };
    return std::tuple(-length(a), a) < std::tuple(-length(b), b);
  }

  void mark_longest(const Tet& tet) {
    Edge longest = edge_of(tet, 0);
    for (std::size_t e = 1; e < 6; ++e)
      if (is_longer(edge_of(tet, e), longest)) longest = edge_of(tet, e);
    midpoints_.try_emplace(longest, -1);
  }

  /// Local index of the longest marked edge.
  std::optional<std::size_t> longest_marked(const Tet& tet) const {
    std::optional<std::size_t> found;
    for (std::size_t e = 0; e < 6; ++e)
      if (midpoints_.contains(edge_of(tet, e)) && (!found || is_longer(edge_of(tet, e), edge_of(tet, *found))))
        found = e;
    return found;
  }

  void number_midpoints() {
    for (auto& [edge, middle] : midpoints_) {
      middle = static_cast<int>(result_.mesh.nodes.size());
      result_.mesh.nodes.push_back(
          (mesh_.nodes[static_cast<std::size_t>(edge[0])] + mesh_.nodes[static_cast<std::size_t>(edge[1])]) / 2);
      result_.midpoint_edges.push_back(edge);
    }
  }

  /// Bisects recursively. Halves keep the winding, since the midpoint replaces one end, then the other.
  void cut(const Tet& tet, int parent) {
    const auto e = longest_marked(tet);
    if (!e) {
      result_.mesh.tets.push_back(tet);
      result_.parents.push_back(parent);
      return;
    }
    const int middle = midpoints_.at(edge_of(tet, *e));
    for (const std::size_t end : tet_edges[*e]) {
      Tet half = tet;
      half[end] = middle;
      cut(half, parent);
    }
  }

  void inherit_fields() {
    result_.mesh.region_names = mesh_.region_names;
    for (const int parent : result_.parents)
      result_.mesh.regions.push_back(mesh_.regions[static_cast<std::size_t>(parent)]);
    if (!mesh_.burns.empty())
      for (const int parent : result_.parents)
        result_.mesh.burns.push_back(mesh_.burns[static_cast<std::size_t>(parent)]);
    for (const ElementField& field : mesh_.fields)
      result_.mesh.fields.push_back(field_of_pieces(field, mesh_, result_.mesh, result_.parents));
  }

  const TetMesh& mesh_;
  Refinement result_;
  std::map<Edge, int> midpoints_;  ///< midpoint node of each marked edge
};

}  // namespace

Refinement refine_longest_edge(const TetMesh& mesh, const std::vector<int>& chosen) {
  Bisection bisection(mesh);
  bisection.mark(chosen);
  return bisection.cut();
}

std::vector<int> doerfler_marking(const std::vector<double>& of_element, double share) {
  std::vector<int> order(of_element.size());
  std::iota(order.begin(), order.end(), 0);
  const auto value = [&](int t) { return of_element[static_cast<std::size_t>(t)]; };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return value(a) > value(b); });
  const double wanted = share * std::accumulate(of_element.begin(), of_element.end(), 0.0);
  std::size_t count = 0;
  for (double sum = 0; count < order.size() && sum < wanted; ++count) sum += value(order[count]);
  order.resize(count);
  std::sort(order.begin(), order.end());
  return order;
}

}  // namespace heml
