#include <doctest/doctest.h>

#include <heml/elastic/springs.hpp>
#include <heml/mesh/generate.hpp>

#include "small_body.hpp"

namespace heml::springs_test {

TEST_CASE("every edge of the mesh is one spring, however many elements share it") {
  // One tetrahedron and its mirror image: nine edges, three of them shared.
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.4, 0.4, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  mesh.regions = {0, 0};
  const Springs<double> springs(mesh, {10.0, 10.0});
  double sum = 0;
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes)
    for (const double v : X) x.push_back(1.5 * v);  // all edges 1.5 times as long: U = Σ k/2 (L/2)²
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}, {2, 3}, {0, 4}, {1, 4}, {2, 4}})
    sum += 10.0 / 2 *
           (mesh.nodes[static_cast<std::size_t>(a)] - mesh.nodes[static_cast<std::size_t>(b)]).squaredNorm() / 4;
  CHECK(springs.energy(x.data()) == doctest::Approx(sum).epsilon(1e-14));
}

TEST_CASE("an edge between regions takes the mean stiffness of the regions, not of the elements") {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.4, 0.4, -1}, {-1, 0.3, 0.2}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}, {0, 3, 2, 5}};
  const Springs<double> springs(mesh, {10.0, 30.0, 10.0});
  // Edge 0-2 belongs to all three elements, two regions: (10 + 30)/2. Move node 2 along it.
  std::vector<double> x;
  for (const Vec3& X : mesh.nodes) x.insert(x.end(), {X.x(), X.y(), X.z()});
  double along = 0;
  springs.each_stiffness(x.data(), false, [&](int a, int b, const double(&B)[3][3]) {
    if (a == 0 && b == 2) along = B[1][1];
  });
  CHECK(along == doctest::Approx(20.0).epsilon(1e-14));
}

TEST_CASE("one spring pulled straight swings at its own frequency's bound") {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  const Springs<double> springs(mesh, {10.0});
  // Three springs meet at every node: 2 · 3k / m.
  CHECK(springs.frequency_bound({2, 2, 2, 2}) == doctest::Approx(30.0));
}

}  // namespace heml::springs_test
