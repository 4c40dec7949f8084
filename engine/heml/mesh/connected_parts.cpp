#include <heml/mesh/connected_parts.hpp>
#include <numeric>

namespace heml {

// Union-find with path halving.
std::vector<int> connected_parts(const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<int> parent(mesh.nodes.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto at = [&](int n) -> int& { return parent[static_cast<std::size_t>(n)]; };
  const auto root = [&](int n) {
    while (at(n) != n) n = at(n) = at(at(n));
    return n;
  };
  for (const Tet& tet : mesh.tets)
    for (const int n : tet) at(root(n)) = root(tet[0]);
  for (std::size_t t = 0; t < midedges.size(); ++t)
    for (const int n : midedges[t]) at(root(n)) = root(mesh.tets[t][0]);
  for (std::size_t n = 0; n < parent.size(); ++n) parent[n] = root(static_cast<int>(n));
  return parent;
}

}  // namespace heml
