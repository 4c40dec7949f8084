#include <heml/mesh/field_of_piece.hpp>
#include <heml/mesh/subdivide.hpp>
#include <map>

namespace heml {
namespace {

/// The midpoints of opposite edges are the diagonals of the inner octahedron.
constexpr int opposite(int edge) { return 5 - edge; }

/// Midpoint nodes of edges, created on first use.
class Midpoints {
 public:
  explicit Midpoints(Subdivision& to) : to_(to) {}
  int between(int a, int b) {
    const std::array ends{std::min(a, b), std::max(a, b)};
    const auto [place, is_new] = numbers_.try_emplace(ends, static_cast<int>(to_.mesh.nodes.size()));
    if (is_new) {
      to_.mesh.nodes.push_back(
          (to_.mesh.nodes[static_cast<std::size_t>(a)] + to_.mesh.nodes[static_cast<std::size_t>(b)]) / 2);
      to_.midpoint_edges.push_back(ends);
    }
    return place->second;
  }

 private:
  Subdivision& to_;
  std::map<std::array<int, 2>, int> numbers_;
};

void add(TetMesh& mesh, Tet tet) {
  const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
  if (signed_volume(at(0), at(1), at(2), at(3)) < 0) std::swap(tet[2], tet[3]);
  mesh.tets.push_back(tet);
}

}  // namespace

/// The four corner tetrahedra, and four round the shortest diagonal of the octahedron between them.
void add_subdivision(const Tet& tet, const std::array<int, 6>& middle, TetMesh& mesh) {
  const auto m = [&](std::size_t a, std::size_t b) {
    for (std::size_t e = 0; e < 6; ++e)
      if (tet_edges[e] == std::array{std::min(a, b), std::max(a, b)}) return middle[e];
    return -1;
  };
  for (std::size_t a = 0; a < 4; ++a) add(mesh, {tet[a], m(a, (a + 1) % 4), m(a, (a + 2) % 4), m(a, (a + 3) % 4)});
  const auto length = [&](int e) {
    return (mesh.nodes[static_cast<std::size_t>(middle[static_cast<std::size_t>(e)])] -
            mesh.nodes[static_cast<std::size_t>(middle[static_cast<std::size_t>(opposite(e))])])
        .squaredNorm();
  };
  int axis = 0;
  for (int e = 1; e < 3; ++e)
    if (length(e) < length(axis)) axis = e;
  // The four other midpoints in order round the diagonal: neighbours share a node of the old tetrahedron.
  const int p = (axis + 1) % 3, q = (axis + 2) % 3;
  const std::array ring{p, q, opposite(p), opposite(q)};
  for (std::size_t k = 0; k < 4; ++k)
    add(mesh, {middle[static_cast<std::size_t>(axis)], middle[static_cast<std::size_t>(opposite(axis))],
               middle[static_cast<std::size_t>(ring[k])], middle[static_cast<std::size_t>(ring[(k + 1) % 4])]});
}

Subdivision subdivide_uniformly(const TetMesh& mesh) {
  Subdivision result;
  result.mesh.nodes = mesh.nodes;
  result.mesh.source = mesh.source;
  result.mesh.region_names = mesh.region_names;
  Midpoints midpoints(result);
  for (const Tet& tet : mesh.tets) {
    std::array<int, 6> middle{};
    for (std::size_t e = 0; e < 6; ++e) middle[e] = midpoints.between(tet[tet_edges[e][0]], tet[tet_edges[e][1]]);
    add_subdivision(tet, middle, result.mesh);
  }
  for (const int region : mesh.regions) result.mesh.regions.insert(result.mesh.regions.end(), 8, region);
  for (const Burn& burn : mesh.burns) result.mesh.burns.insert(result.mesh.burns.end(), 8, burn);
  std::vector<int> parents;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) parents.insert(parents.end(), 8, static_cast<int>(t));
  for (const ElementField& field : mesh.fields)
    result.mesh.fields.push_back(field_of_pieces(field, mesh, result.mesh, parents));
  return result;
}

}  // namespace heml
