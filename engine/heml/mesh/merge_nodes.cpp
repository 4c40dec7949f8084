#include <algorithm>
#include <heml/mesh/merge_nodes.hpp>
#include <numeric>

namespace heml {
namespace {

bool precedes(const Vec3& a, const Vec3& b) {
  return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace

std::vector<int> equal_nodes(const TriangleMesh& surface) {
  std::vector<int> order(surface.nodes.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Vec3 &x = surface.nodes[a], &y = surface.nodes[b];
    return precedes(x, y) || (!precedes(y, x) && a < b);
  });
  std::vector<int> same(surface.nodes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    same[order[i]] = i > 0 && surface.nodes[order[i]] == surface.nodes[order[i - 1]] ? same[order[i - 1]] : order[i];
  return same;
}

TriangleMesh merge_nodes(const TriangleMesh& surface, const std::vector<int>& same) {
  TriangleMesh result;
  result.source = surface.source;
  std::vector<int> number(surface.nodes.size(), -1);
  for (Triangle triangle : surface.triangles) {
    for (int& node : triangle) node = same[node];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
    for (int& node : triangle) {
      if (number[node] < 0) {
        number[node] = static_cast<int>(result.nodes.size());
        result.nodes.push_back(surface.nodes[node]);
      }
      node = number[node];
    }
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace heml
