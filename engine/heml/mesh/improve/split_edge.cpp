#include <algorithm>
#include <heml/mesh/improve/smooth_node.hpp>
#include <heml/mesh/improve/split_edge.hpp>

namespace heml {
namespace {

std::vector<int> elements_round(const LocalMesh& mesh, int a, int b) {
  std::vector<int> tets;
  for (const int t : mesh.star(a))
    if (std::find(mesh.tet(t).begin(), mesh.tet(t).end(), b) != mesh.tet(t).end()) tets.push_back(t);
  return tets;
}

bool is_on_surface(const LocalMesh& mesh, int a, int b) {
  const auto faces = mesh.surface_faces(a);
  return std::any_of(faces.begin(), faces.end(), [&](const Triangle& f) { return f[1] == b || f[2] == b; });
}

}  // namespace

int split_edge(LocalMesh& mesh, int a, int b) {
  const std::vector<int> removed = elements_round(mesh, a, b);
  const int middle = mesh.add_node((mesh.node(a) + mesh.node(b)) / 2, is_on_surface(mesh, a, b));
  std::vector<RegionTet> added;
  for (const int t : removed)
    for (const int end : {a, b}) {
      RegionTet half{mesh.tet(t), mesh.region(t)};
      std::replace(half.nodes.begin(), half.nodes.end(), end, middle);
      added.push_back(half);
    }
  mesh.replace(removed, added);
  return middle;
}

bool split_if_better(LocalMesh& mesh, const SurfaceGuard& guard, int a, int b) {
  const std::vector<int> round = elements_round(mesh, a, b);
  const double before = mesh.worst(round);
  std::vector<RegionTet> old;
  for (const int t : round) old.push_back({mesh.tet(t), mesh.region(t)});
  const int middle = split_edge(mesh, a, b);
  while (!(mesh.worst(mesh.star(middle)) > before + smallest_gain)) {
    if (smooth_node(mesh, guard, middle)) continue;
    const std::vector<int> halves(mesh.star(middle).begin(), mesh.star(middle).end());
    mesh.replace(halves, old);
    mesh.remove_last_node();
    return false;
  }
  return true;
}

}  // namespace heml
