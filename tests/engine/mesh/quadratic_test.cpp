#include <doctest/doctest.h>

#include <algorithm>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quadratic.hpp>
#include <heml/mesh/reorder.hpp>
#include <map>
#include <set>

namespace heml::quadratic_mesh_test {

namespace {

double volume_of(const TetMesh& mesh) {
  double sum = 0;
  for (const Tet& tet : mesh.tets) {
    const auto X = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(tet[a])]; };
    const double volume = signed_volume(X(0), X(1), X(2), X(3));
    CHECK(volume > 0);
    sum += volume;
  }
  return sum;
}

}  // namespace

TEST_CASE("mid-edge nodes are numbered by ascending ends, after the nodes of the file") {
  TetMesh mesh = make_box(Vec3(3, 2, 1), {2, 2, 1});
  const auto corners = static_cast<int>(mesh.nodes.size());
  const MidEdges midedges = add_midedge_nodes(mesh);
  std::map<std::pair<int, int>, int> number;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const int a = mesh.tets[t][tet_edges[e][0]], b = mesh.tets[t][tet_edges[e][1]], middle = midedges[t][e];
      const auto at = [&](int n) { return mesh.nodes[static_cast<std::size_t>(n)]; };
      CHECK((at(middle) - (at(a) + at(b)) / 2).norm() == 0);
      const auto [place, is_new] = number.try_emplace(std::minmax(a, b), middle);
      CHECK(place->second == middle);
    }
  int next = corners;
  for (const auto& [ends, middle] : number) CHECK(middle == next++);
  CHECK(next == static_cast<int>(mesh.nodes.size()));
  CHECK(count_nodes(midedges) == number.size());
}

TEST_CASE("parts of quadratic tetrahedra fill them, and so do their integration points") {
  TetMesh mesh = make_box(Vec3(3, 2, 1), {2, 1, 1});
  mesh.fields.push_back({"stiffness", 1, std::vector<double>(mesh.tets.size(), 2.0)});
  const MidEdges midedges = add_midedge_nodes(mesh);
  const TetMesh parts = subdivided(mesh, midedges), points = virtual_tets(mesh, midedges);
  CHECK(parts.tets.size() == 8 * mesh.tets.size());
  CHECK(points.tets.size() == 4 * mesh.tets.size());
  CHECK(points.fields.front().values.size() == points.tets.size());
  CHECK(volume_of(parts) == doctest::Approx(6));
  CHECK(volume_of(points) == doctest::Approx(6));
}

TEST_CASE("every two nodes of a quadratic tetrahedron are coupled") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  const MidEdges midedges = add_midedge_nodes(mesh);
  std::set<std::pair<int, int>> coupled, expected;
  for (const Tet& nodes : coupled_nodes(mesh, midedges))
    for (const int a : nodes)
      for (const int b : nodes) coupled.insert({a, b});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const int a : quadratic_nodes(mesh.tets[t], midedges[t]))
      for (const int b : quadratic_nodes(mesh.tets[t], midedges[t])) expected.insert({a, b});
  CHECK(coupled == expected);
}

TEST_CASE("the boundary of quadratic tetrahedra is drawn as four triangles a face, outward") {
  TetMesh mesh = make_box(Vec3(3, 2, 1), {2, 1, 1});
  const MidEdges midedges = add_midedge_nodes(mesh);
  const BoundaryFaces coarse = extract_boundary(mesh), fine = fine_boundary(mesh, midedges);
  CHECK(fine.triangles.size() == 4 * coarse.triangles.size());
  CHECK(fine.tets.size() == fine.triangles.size());
  Vec3 sum = Vec3::Zero();
  double area = 0, volume = 0;
  for (const Triangle& face : fine.triangles) {
    const auto X = [&](std::size_t c) { return mesh.nodes[static_cast<std::size_t>(face[c])]; };
    const Vec3 normal = (X(1) - X(0)).cross(X(2) - X(0)) / 2;
    sum += normal;
    area += normal.norm();
    volume += X(0).dot(normal) / 3;
  }
  CHECK(sum.norm() <= 1e-12);
  CHECK(area == doctest::Approx(22));
  CHECK(volume == doctest::Approx(6));
  CHECK(fine_boundary(mesh, {}).triangles.size() == coarse.triangles.size());
}

TEST_CASE("mid-edge nodes follow when nodes and elements are put in order") {
  TetMesh mesh = make_box(Vec3(3, 2, 1), {3, 2, 1});
  const MidEdges midedges = add_midedge_nodes(mesh);
  const Reordering order = hilbert_order(mesh, midedges);
  const TetMesh inner = reordered(mesh, order);
  const MidEdges inside = reordered(midedges, order);
  for (std::size_t t = 0; t < inside.size(); ++t)
    for (std::size_t e = 0; e < 6; ++e) {
      const auto X = [&](int n) { return inner.nodes[static_cast<std::size_t>(n)]; };
      CHECK((X(inside[t][e]) - (X(inner.tets[t][tet_edges[e][0]]) + X(inner.tets[t][tet_edges[e][1]])) / 2).norm() ==
            0);
    }
}

}  // namespace heml::quadratic_mesh_test
