#include <doctest/doctest.h>

#include <algorithm>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/surface.hpp>
#include <map>
#include <set>

namespace heml::surface_test {

namespace {
double enclosed_volume(const TetMesh& mesh, const std::vector<Triangle>& triangles) {
  double volume = 0;
  for (const auto& [a, b, c] : triangles) volume += mesh.nodes[a].dot(mesh.nodes[b].cross(mesh.nodes[c])) / 6;
  return volume;
}
}  // namespace

TEST_CASE("the boundary of one tetrahedron is its four faces, outward") {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {0}, ""};
  const BoundaryFaces boundary = extract_boundary(mesh);
  REQUIRE(boundary.triangles.size() == 4);
  CHECK(boundary.tets == std::vector<int>(4, 0));
  const Vec3 centre(0.25, 0.25, 0.25);
  for (const auto& [a, b, c] : boundary.triangles) {
    const Vec3 normal = (mesh.nodes[b] - mesh.nodes[a]).cross(mesh.nodes[c] - mesh.nodes[a]);
    CHECK(normal.dot(mesh.nodes[a] - centre) > 0);
  }
}

TEST_CASE("the boundary of a box is closed, oriented alike, and encloses its volume") {
  const TetMesh box = make_box(Vec3(0.3, 0.2, 0.1), {5, 4, 3}, Vec3(1, 1, 1));
  const BoundaryFaces boundary = extract_boundary(box);
  std::map<std::pair<int, int>, int> directed;
  for (const auto& t : boundary.triangles)
    for (int a = 0; a < 3; ++a) ++directed[{t[a], t[(a + 1) % 3]}];
  for (const auto& [edge, count] : directed) {
    CHECK(count == 1);
    CHECK(directed.count({edge.second, edge.first}) == 1);
  }
  CHECK(enclosed_volume(box, boundary.triangles) == doctest::Approx(0.3 * 0.2 * 0.1).epsilon(1e-12));
}

TEST_CASE("each boundary face belongs to the tetrahedron named behind it, in ascending order") {
  const TetMesh box = make_box(Vec3(1, 1, 1), {2, 2, 2});
  const BoundaryFaces boundary = extract_boundary(box);
  REQUIRE(boundary.triangles.size() == boundary.tets.size());
  CHECK(std::is_sorted(boundary.tets.begin(), boundary.tets.end()));
  for (std::size_t f = 0; f < boundary.tets.size(); ++f) {
    const Tet& tet = box.tets[boundary.tets[f]];
    for (int node : boundary.triangles[f]) CHECK(std::count(tet.begin(), tet.end(), node) == 1);
  }
}

TEST_CASE("a face shared by two tetrahedra is inside, whatever the order of its nodes") {
  const TetMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {{0, 1, 2, 3}, {4, 3, 2, 1}}, {0, 0}, ""};
  CHECK(extract_boundary(mesh).triangles.size() == 6);
}

TEST_CASE("a mesh of nothing has no boundary") { CHECK(extract_boundary(TetMesh{}).triangles.empty()); }

}  // namespace heml::surface_test
