#include <algorithm>
#include <heml/session/wound_rim.hpp>
#include <map>

namespace heml {
namespace {

using Place = std::array<float, 3>;

Place place_of(const SurfaceMesh& surface, int node) {
  const Vec3f& x = surface.rest[static_cast<std::size_t>(node)];
  return {x.x(), x.y(), x.z()};
}

/// An edge of an original face, in its direction.
struct OpenEdge {
  int from, to, face;
  std::array<int, 2> ends() const { return {std::min(from, to), std::max(from, to)}; }
};

/// Those of exactly one original face.
std::vector<OpenEdge> open_edges(const SurfaceMesh& surface, const std::vector<char>& exposed) {
  std::vector<OpenEdge> edges, open;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && !exposed[t]; ++k)
      edges.push_back({surface.triangles[t][k], surface.triangles[t][(k + 1) % 3], static_cast<int>(t)});
  std::stable_sort(edges.begin(), edges.end(),
                   [](const OpenEdge& a, const OpenEdge& b) { return a.ends() < b.ends(); });
  for (std::size_t i = 0; i < edges.size(); ++i)
    if ((i == 0 || edges[i - 1].ends() != edges[i].ends()) &&
        (i + 1 == edges.size() || edges[i + 1].ends() != edges[i].ends()))
      open.push_back(edges[i]);
  return open;
}

}  // namespace

WoundRim wound_rim(const SurfaceMesh& surface, const std::vector<char>& exposed) {
  WoundRim rim;
  std::map<Place, int> known;
  std::map<std::array<int, 2>, std::array<int, 2>> edges;  // faces by nodes
  const auto node_at = [&](int n) {
    const auto [at, is_new] = known.try_emplace(place_of(surface, n), static_cast<int>(rim.nodes.size()));
    if (is_new) rim.nodes.push_back({surface.rest[static_cast<std::size_t>(n)].cast<double>(), Vec3::Zero()});
    return at->second;
  };
  for (const OpenEdge& edge : open_edges(surface, exposed)) {
    const int i = node_at(edge.from), j = node_at(edge.to);
    if (i == j) continue;
    std::array<int, 2>& faces = edges.try_emplace({std::min(i, j), std::max(i, j)}, std::array{-1, -1}).first->second;
    faces[i < j ? 0 : 1] = edge.face;
  }
  for (const auto& [nodes, faces] : edges) rim.edges.push_back({nodes, faces});
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (exposed[t]) continue;
    std::array<Vec3, 3> x;
    for (std::size_t k = 0; k < 3; ++k)
      x[k] = surface.rest[static_cast<std::size_t>(surface.triangles[t][k])].cast<double>();
    for (const int n : surface.triangles[t])
      if (const auto at = known.find(place_of(surface, n)); at != known.end())
        rim.nodes[static_cast<std::size_t>(at->second)].normal += (x[1] - x[0]).cross(x[2] - x[0]);
  }
  for (WoundRim::Node& node : rim.nodes) node.normal.normalize();
  return rim;
}

}  // namespace heml
