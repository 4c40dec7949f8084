#include <algorithm>
#include <heml/math/closest.hpp>
#include <heml/session/original_skin.hpp>

namespace heml {
namespace {

constexpr double tolerance_in_edges = 1e-4;

TriangleMesh in_double(const SurfaceMesh& surface_mesh) {
  TriangleMesh mesh;
  for (const Vec3f& node : surface_mesh.rest) mesh.nodes.push_back(node.cast<double>());
  mesh.triangles = surface_mesh.triangles;
  return mesh;
}

Triangle in_order(Triangle triangle) {
  std::sort(triangle.begin(), triangle.end());
  return triangle;
}

Triangle file_numbers(const SurfaceMesh& surface_mesh, const Triangle& triangle) {
  return in_order({surface_mesh.nodes[triangle[0]], surface_mesh.nodes[triangle[1]], surface_mesh.nodes[triangle[2]]});
}

}  // namespace

OriginalSkin::OriginalSkin(const SurfaceMesh& surface_mesh) : tree_(in_double(*surface_mesh.whole)) {
  double sum = 0;
  const TriangleMesh& whole = tree_.surface();
  for (const auto& [a, b, c] : whole.triangles) sum += (whole.nodes[a] - whole.nodes[b]).norm();
  tolerance_ = tolerance_in_edges * sum / static_cast<double>(std::max<std::size_t>(1, whole.triangles.size()));
  place_nodes(surface_mesh);
  find_exposed(surface_mesh);
}

OriginalSkin::Place OriginalSkin::nearest(const Vec3f& rest) const {
  const Vec3 point = rest.cast<double>();
  const SurfaceTree::Nearest found = tree_.nearest(point);
  if (found.triangle < 0) return {{0, 0, 0}, {1, 0, 0}, 0};
  const auto corners = tree_.corners(found.triangle);
  const auto weights = closest_point_weights(point, corners[0], corners[1], corners[2]);
  return {tree_.surface().triangles[static_cast<std::size_t>(found.triangle)],
          {static_cast<float>(weights[0]), static_cast<float>(weights[1]), static_cast<float>(weights[2])},
          static_cast<float>(found.distance)};
}

/// Nodes that the original skin has are known without a search. Both lists of nodes are ascending.
void OriginalSkin::place_nodes(const SurfaceMesh& surface_mesh) {
  const std::vector<int>& known = surface_mesh.whole->nodes;
  for (std::size_t i = 0; i < surface_mesh.nodes.size(); ++i) {
    const auto at = std::lower_bound(known.begin(), known.end(), surface_mesh.nodes[i]);
    const auto node = static_cast<int>(at - known.begin());
    if (at != known.end() && *at == surface_mesh.nodes[i])
      places_.push_back({{node, node, node}, {1, 0, 0}, 0});
    else
      places_.push_back(nearest(surface_mesh.rest[i]));
  }
}

/// A face that is no original one is a part of one if its corners and its centroid lie on the original skin.
void OriginalSkin::find_exposed(const SurfaceMesh& surface_mesh) {
  std::vector<Triangle> known;
  for (const Triangle& triangle : surface_mesh.whole->triangles)
    known.push_back(file_numbers(*surface_mesh.whole, triangle));
  std::sort(known.begin(), known.end());
  for (const Triangle& triangle : surface_mesh.triangles) {
    const bool is_original =
        std::binary_search(known.begin(), known.end(), file_numbers(surface_mesh, triangle)) ||
        (std::all_of(triangle.begin(), triangle.end(),
                     [&](int node) { return static_cast<double>(places_[node].depth) <= tolerance_; }) &&
         is_on_skin((surface_mesh.rest[triangle[0]] + surface_mesh.rest[triangle[1]] + surface_mesh.rest[triangle[2]]) /
                    3));
    exposed_.push_back(!is_original);
  }
}

}  // namespace heml
