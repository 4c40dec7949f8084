#include <algorithm>
#include <heml/mesh/mend/half_edges.hpp>
#include <tuple>

namespace heml {

HalfEdges find_half_edges(const TriangleMesh& surface) {
  struct Edge {
    int low, high, half;
    bool operator<(const Edge& other) const {
      return std::tie(low, high, half) < std::tie(other.low, other.high, other.half);
    }
  };
  std::vector<Edge> edges;
  edges.reserve(3 * surface.triangles.size());
  for (int half = 0; half < static_cast<int>(3 * surface.triangles.size()); ++half) {
    const auto [low, high] = std::minmax({HalfEdges::from(surface, half), HalfEdges::to(surface, half)});
    edges.push_back({low, high, half});
  }
  std::sort(edges.begin(), edges.end());
  HalfEdges found{std::vector<int>(edges.size(), HalfEdges::open)};
  for (std::size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].low == edges[first].low && edges[last].high == edges[first].high) ++last;
    if (last - first == 2) {
      found.across[edges[first].half] = edges[first + 1].half;
      found.across[edges[first + 1].half] = edges[first].half;
    } else if (last - first > 2) {
      for (std::size_t e = first; e < last; ++e) found.across[edges[e].half] = HalfEdges::crowded;
    }
  }
  return found;
}

}  // namespace heml
