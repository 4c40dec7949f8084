#pragma once
// Quadratic (ten-node) tetrahedra: their mid-edge nodes, and their four integration points as linear tetrahedra.
//
// With barycentric coordinates λ of an integration point, ∂N/∂λ of the quadratic shape functions defines four virtual
// corners y_i = s [(4λ_i − 1) x_i + Σ_{j≠i} 4λ_j x_ij], x_ij the node in the middle of edge ij. The deformation
// gradient at the point is that of a linear tetrahedron from the virtual corners of the rest shape to those of the
// deformed shape. The scale s = 4^(−1/3) makes its volume the weight of the point, a quarter of the element's.
//
//     3                     4 points of equal weight: λ = (5+3√5)/20 once and (5−√5)/20 three times
//     | ·.                  point q, virtual corner i: node 4 q + i of the element's 16 virtual nodes
//    13   23
//     |     ·.              nodes of an element: corners 0..3, then the middles of tet_edges, 01 02 03 12 13 23
//     1 ─12── 2   (0 behind)
#include <heml/mesh/surface.hpp>
#include <heml/mesh/tet_mesh.hpp>
#include <vector>

namespace heml {

/// Mid-edge nodes of each tetrahedron (#T), in the order of tet_edges; empty: linear tetrahedra.
using MidEdges = std::vector<std::array<int, 6>>;

inline constexpr std::size_t element_points = 4;  ///< integration points of a quadratic tetrahedron

/// Barycentric coordinate i of integration point q.
constexpr double point_coordinate(std::size_t q, std::size_t i) {
  return q == i ? 0.58541019662496845446 : 0.13819660112501051518;
}

/// The index in tet_edges of the edge between two local corners.
constexpr std::size_t edge_between(std::size_t i, std::size_t j) {
  for (std::size_t e = 0; e < tet_edges.size(); ++e)
    if (tet_edges[e][0] + tet_edges[e][1] == i + j && (tet_edges[e][0] == i || tet_edges[e][0] == j)) return e;
  return tet_edges.size();
}

/// A node of an element and its weight in a virtual corner.
struct WeightedNode {
  std::size_t node;  ///< 0..9, local
  double weight;
};

/// The four nodes that virtual corner i of point q is a sum of.
constexpr std::array<WeightedNode, 4> virtual_corner(std::size_t q, std::size_t i) {
  constexpr double scale = 0.62996052494743658238;
  std::array<WeightedNode, 4> nodes{};
  for (std::size_t j = 0; j < 4; ++j)
    nodes[j] = j == i ? WeightedNode{i, scale * (4 * point_coordinate(q, i) - 1)}
                      : WeightedNode{4 + edge_between(i, j), scale * 4 * point_coordinate(q, j)};
  return nodes;
}

/// Of the four nodes of a virtual corner one has the larger barycentric coordinate of its point in its weight. Corner i
/// of every point shares the rest: y_qi = y_i + own x_qi, x_qi in the middle of edge qi, or corner i itself where q is
/// i.
inline constexpr double corner_weight = virtual_corner(0, 1)[1].weight, midedge_weight = virtual_corner(0, 1)[2].weight;
inline constexpr double own_weight = virtual_corner(0, 0)[0].weight - corner_weight;

/// The local node in the middle of edge ij, or of the corner if i is j.
inline constexpr auto node_between = [] {
  std::array<std::array<std::size_t, 4>, 4> node{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) node[i][j] = i == j ? i : 4 + edge_between(i, j);
  return node;
}();

/// The ten shape functions at a place in an element, given by its barycentric coordinates.
constexpr std::array<double, 10> shape_functions(const std::array<double, 4>& place) {
  std::array<double, 10> N{};
  for (std::size_t i = 0; i < 4; ++i) N[i] = place[i] * (2 * place[i] - 1);
  for (std::size_t e = 0; e < 6; ++e) N[4 + e] = 4 * place[tet_edges[e][0]] * place[tet_edges[e][1]];
  return N;
}

/// Barycentric coordinates of integration point q.
constexpr std::array<double, 4> point_place(std::size_t q) {
  return {point_coordinate(q, 0), point_coordinate(q, 1), point_coordinate(q, 2), point_coordinate(q, 3)};
}

/// The ten nodes of an element.
std::array<int, 10> quadratic_nodes(const Tet& tet, const std::array<int, 6>& midedges);

/// Appends a node in the middle of each edge to the mesh, by ascending (smaller, larger) end node.
MidEdges add_midedge_nodes(TetMesh& mesh);

/// Adds the mid-edge nodes between two nodes of a list, which becomes ascending, each once.
void add_midedges_between(const TetMesh& mesh, const MidEdges& midedges, std::vector<int>& nodes);

/// How many different nodes there are.
std::size_t count_nodes(const MidEdges& midedges);

/// The integration points as linear tetrahedra, 4 #T, on virtual nodes of their own, 16 #T, of each element
/// relative to its first node. Regions and fields are those of the elements.
TetMesh virtual_tets(const TetMesh& mesh, const MidEdges& midedges);

/// Eight linear tetrahedra an element on the same nodes, for preconditioners and drawing.
TetMesh subdivided(const TetMesh& mesh, const MidEdges& midedges);

/// Quadruples of nodes, ten an element: two nodes of one element are together in one at least.
std::vector<Tet> coupled_nodes(const TetMesh& mesh, const MidEdges& midedges);

/// The nodes in the middle of the edges 01, 12, 20 of each face.
std::vector<Triangle> face_midedges(const BoundaryFaces& faces, const TetMesh& mesh, const MidEdges& midedges);

/// The boundary of a mesh as triangles between neighbouring nodes: four a face of quadratic tetrahedra.
BoundaryFaces fine_boundary(const TetMesh& mesh, const MidEdges& midedges);

/// Signed volumes (m³) of the integration points of an element, at positions given by position(node).
template <class Position>
std::array<double, element_points> point_volumes(const Tet& tet, const std::array<int, 6>& midedges,
                                                 const Position& position) {
  const std::array<int, 10> nodes = quadratic_nodes(tet, midedges);
  std::array<Vec3, 10> x;
  for (std::size_t a = 0; a < 10; ++a) x[a] = position(nodes[a]);
  std::array<Vec3, 4> shared, y;
  for (std::size_t i = 0; i < 4; ++i) {
    Vec3 middles = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) middles += x[node_between[i][j]];
    shared[i] = corner_weight * x[i] + midedge_weight * middles;
  }
  std::array<double, element_points> volumes;
  for (std::size_t q = 0; q < element_points; ++q) {
    for (std::size_t i = 0; i < 4; ++i) y[i] = shared[i] + own_weight * x[node_between[q][i]];
    volumes[q] = signed_volume(y[0], y[1], y[2], y[3]);
  }
  return volumes;
}

/// Number of integration points whose volume ratio is not positive at positions given by position(node).
template <class Position>
int count_inverted_points(const std::vector<Tet>& tets, const MidEdges& midedges, const Position& position) {
  int count = 0;
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (const double volume : point_volumes(tets[t], midedges[t], position))
      if (!(volume > 0)) ++count;
  return count;
}

}  // namespace heml
