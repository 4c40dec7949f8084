#include <algorithm>
#include <heml/mesh/faces.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/subdivide.hpp>
#include <utility>

namespace heml {

std::array<int, 10> quadratic_nodes(const Tet& tet, const std::array<int, 6>& midedges) {
  std::array<int, 10> nodes;
  std::copy(tet.begin(), tet.end(), nodes.begin());
  std::copy(midedges.begin(), midedges.end(), nodes.begin() + 4);
  return nodes;
}

MidEdges add_midedge_nodes(TetMesh& mesh) {
  using Ends = std::pair<int, int>;
  const auto edge_of = [](const Tet& tet, std::size_t e) {
    return Ends(std::minmax(tet[tet_edges[e][0]], tet[tet_edges[e][1]]));
  };
  std::vector<Ends> edges;
  edges.reserve(6 * mesh.tets.size());
  for (const Tet& tet : mesh.tets)
    for (std::size_t e = 0; e < 6; ++e) edges.push_back(edge_of(tet, e));
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto first = static_cast<int>(mesh.nodes.size());
  for (const auto& [a, b] : edges)
    mesh.nodes.push_back((mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2);
  MidEdges midedges(mesh.tets.size());
  for (std::size_t t = 0; t < midedges.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e)
      midedges[t][e] = first + static_cast<int>(std::lower_bound(edges.begin(), edges.end(), edge_of(mesh.tets[t], e)) -
                                                edges.begin());
  return midedges;
}

void add_midedges_between(const TetMesh& mesh, const MidEdges& midedges, std::vector<int>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  const std::size_t listed = nodes.size();
  const auto is_listed = [&](int n) {
    return std::binary_search(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(listed), n);
  };
  for (std::size_t t = 0; t < midedges.size(); ++t)
    for (std::size_t e = 0; e < tet_edges.size(); ++e)
      if (is_listed(mesh.tets[t][tet_edges[e][0]]) && is_listed(mesh.tets[t][tet_edges[e][1]]))
        nodes.push_back(midedges[t][e]);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

std::size_t count_nodes(const MidEdges& midedges) {
  std::vector<int> nodes;
  for (const auto& of_element : midedges) nodes.insert(nodes.end(), of_element.begin(), of_element.end());
  std::sort(nodes.begin(), nodes.end());
  return static_cast<std::size_t>(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
}

namespace {

/// Regions, burns and fields of a mesh with `each` elements in the place of one. Values at integration points go to
/// those.
void repeat_values(const TetMesh& mesh, std::size_t each, TetMesh& result) {
  for (const Burn& burn : mesh.burns) result.burns.insert(result.burns.end(), each, burn);
  for (const int region : mesh.regions) result.regions.insert(result.regions.end(), each, region);
  for (const ElementField& field : mesh.fields) {
    const bool is_of_points = field.components == point_components && each == element_points;
    ElementField& finer = result.fields.emplace_back(ElementField{field.name, is_of_points ? 3 : field.components, {}});
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      for (std::size_t child = 0; child < each; ++child) {
        const std::size_t first = t * field.components + (is_of_points ? 3 * child : 0);
        finer.values.insert(finer.values.end(), field.values.begin() + static_cast<std::ptrdiff_t>(first),
                            field.values.begin() + static_cast<std::ptrdiff_t>(first + finer.components));
      }
  }
}

}  // namespace

TetMesh virtual_tets(const TetMesh& mesh, const MidEdges& midedges) {
  TetMesh result;
  result.source = mesh.source;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::array<int, 10> nodes = quadratic_nodes(mesh.tets[t], midedges[t]);
    const Vec3& origin = mesh.nodes[static_cast<std::size_t>(nodes[0])];
    for (std::size_t q = 0; q < element_points; ++q) {
      const auto first = static_cast<int>(result.nodes.size());
      for (std::size_t i = 0; i < 4; ++i) {
        Vec3& corner = result.nodes.emplace_back(Vec3::Zero());
        for (const auto& [node, weight] : virtual_corner(q, i))
          corner += weight * (mesh.nodes[static_cast<std::size_t>(nodes[node])] - origin);
      }
      result.tets.push_back({first, first + 1, first + 2, first + 3});
    }
  }
  repeat_values(mesh, element_points, result);
  return result;
}

TetMesh subdivided(const TetMesh& mesh, const MidEdges& midedges) {
  TetMesh result;
  result.source = mesh.source;
  result.nodes = mesh.nodes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) add_subdivision(mesh.tets[t], midedges[t], result);
  repeat_values(mesh, 8, result);
  return result;
}

std::vector<Tet> coupled_nodes(const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<Tet> result;
  result.reserve(10 * mesh.tets.size());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const std::array<int, 10> n = quadratic_nodes(mesh.tets[t], midedges[t]);
    for (std::size_t a = 0; a < 10; a += 2)  // the pairs of five pairs of nodes
      for (std::size_t b = a + 2; b < 10; b += 2) result.push_back({n[a], n[a + 1], n[b], n[b + 1]});
  }
  return result;
}

std::vector<Triangle> face_midedges(const BoundaryFaces& faces, const TetMesh& mesh, const MidEdges& midedges) {
  std::vector<Triangle> result;
  for (std::size_t f = 0; f < faces.triangles.size(); ++f) {
    const auto t = static_cast<std::size_t>(faces.tets[f]);
    const auto local = [&](int node) {
      return static_cast<std::size_t>(std::find(mesh.tets[t].begin(), mesh.tets[t].end(), node) - mesh.tets[t].begin());
    };
    Triangle& middle = result.emplace_back();
    for (std::size_t c = 0; c < 3; ++c)
      middle[c] = midedges[t][edge_between(local(faces.triangles[f][c]), local(faces.triangles[f][(c + 1) % 3]))];
  }
  return result;
}

BoundaryFaces fine_boundary(const TetMesh& mesh, const MidEdges& midedges) {
  BoundaryFaces faces = extract_boundary(mesh);
  if (midedges.empty()) return faces;
  const std::vector<Triangle> middles = face_midedges(faces, mesh, midedges);
  BoundaryFaces result;
  for (std::size_t f = 0; f < middles.size(); ++f) {
    const auto& [a, b, c] = faces.triangles[f];
    const auto& [ab, bc, ca] = middles[f];
    for (const Triangle& part : {Triangle{a, ab, ca}, Triangle{ab, b, bc}, Triangle{ca, bc, c}, Triangle{ab, bc, ca}})
      result.triangles.push_back(part);
    result.tets.insert(result.tets.end(), 4, faces.tets[f]);
  }
  return result;
}

}  // namespace heml
