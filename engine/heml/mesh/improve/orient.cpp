#include <fmt/format.h>

#include <algorithm>
#include <heml/base/error.hpp>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/improve/orient.hpp>
#include <tuple>

namespace heml {
namespace {

/// A face of an element: sorted nodes, and whether the element sees them in even order.
struct OrientedFace {
  Triangle nodes;
  int tet;
  bool even;
};

OrientedFace oriented_face(const Tet& tet, int t, int f) {
  OrientedFace face{{tet[tet_faces[f][0]], tet[tet_faces[f][1]], tet[tet_faces[f][2]]}, t, true};
  for (const auto& [i, j] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)})
    if (face.nodes[i] > face.nodes[j]) {
      std::swap(face.nodes[i], face.nodes[j]);
      face.even = !face.even;
    }
  return face;
}

struct OrientedNeighbour {
  int tet;
  bool agrees;  ///< whether both see the common face from opposite sides
};

std::vector<std::vector<OrientedNeighbour>> neighbours_of(const TetMesh& mesh) {
  std::vector<OrientedFace> faces;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    for (int f = 0; f < 4; ++f) faces.push_back(oriented_face(mesh.tets[t], t, f));
  std::sort(faces.begin(), faces.end(), [](const OrientedFace& a, const OrientedFace& b) {
    return std::tie(a.nodes, a.tet) < std::tie(b.nodes, b.tet);
  });
  std::vector<std::vector<OrientedNeighbour>> neighbours(mesh.tets.size());
  for (std::size_t k = 1; k < faces.size(); ++k) {
    const OrientedFace &a = faces[k - 1], &b = faces[k];
    if (a.nodes != b.nodes) continue;
    if (k + 1 < faces.size() && faces[k + 1].nodes == b.nodes)
      throw InputError(mesh.source, fmt::format("element {}", faces[k + 1].tet),
                       fmt::format("is the third with the face of nodes {}, {} and {}, after elements {} and {}",
                                   b.nodes[0], b.nodes[1], b.nodes[2], a.tet, b.tet),
                       "remove elements that are given twice or overlap");
    neighbours[a.tet].push_back({b.tet, a.even != b.even});
    neighbours[b.tet].push_back({a.tet, a.even != b.even});
  }
  return neighbours;
}

double volume_of(const TetMesh& mesh, int t) {
  const Tet& tet = mesh.tets[t];
  return signed_volume(mesh.nodes[tet[0]], mesh.nodes[tet[1]], mesh.nodes[tet[2]], mesh.nodes[tet[3]]);
}

/// Orients a connected part alike from its first element.
void orient_part(TetMesh& mesh, int first, const std::vector<std::vector<OrientedNeighbour>>& neighbours,
                 std::vector<signed char>& turn) {
  std::vector<int> part{first};
  turn[first] = 1;
  for (std::size_t k = 0; k < part.size(); ++k)
    for (const OrientedNeighbour& next : neighbours[part[k]]) {
      const signed char wanted = next.agrees ? turn[part[k]] : static_cast<signed char>(-turn[part[k]]);
      if (turn[next.tet] == 0) {
        turn[next.tet] = wanted;
        part.push_back(next.tet);
      } else if (turn[next.tet] != wanted) {
        throw InputError(mesh.source, fmt::format("element {}", next.tet),
                         fmt::format("cannot be oriented like its neighbour, element {}", part[k]),
                         "the elements form no body");
      }
    }
  if (std::all_of(part.begin(), part.end(), [&](int t) { return neighbours[t].size() == 4; }))
    throw InputError(mesh.source, fmt::format("element {}", first),
                     fmt::format("is of a part of {} elements without a surface: they overlap", part.size()),
                     "remove elements that are given twice or overlap");
  double volume = 0;
  for (const int t : part) volume += turn[t] * volume_of(mesh, t);
  for (const int t : part)
    if ((turn[t] < 0) != (volume < 0)) std::swap(mesh.tets[t][2], mesh.tets[t][3]);
}

}  // namespace

std::vector<int> orient_elements(TetMesh& mesh) {
  const auto neighbours = neighbours_of(mesh);
  std::vector<signed char> turn(mesh.tets.size(), 0);
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    if (turn[t] == 0) orient_part(mesh, t, neighbours, turn);
  std::vector<int> inverted;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t)
    if (!(volume_of(mesh, t) > 0)) inverted.push_back(t);
  return inverted;
}

}  // namespace heml
