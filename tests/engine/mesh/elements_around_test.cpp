#include <doctest/doctest.h>

#include <heml/mesh/elements_around.hpp>
#include <heml/mesh/generate.hpp>

namespace heml::elements_around_test {

TEST_CASE("elements beside another share three nodes with it, and those removed are none") {
  const TetMesh mesh = make_box({1, 1, 1}, {3, 3, 3});
  Topology topology = full_topology(mesh);
  std::erase_if(topology.elements, [](int t) { return t % 7 == 3; });
  const ElementsAround around(mesh, topology);
  for (const int t : topology.elements) {
    std::vector<int> beside = around.beside(t), expected;
    std::sort(beside.begin(), beside.end());
    const Tet& corners = mesh.tets[static_cast<std::size_t>(t)];
    for (const int other : topology.elements) {
      int shared = 0;
      for (const int n : mesh.tets[static_cast<std::size_t>(other)])
        shared += std::find(corners.begin(), corners.end(), n) != corners.end();
      if (shared == 3) expected.push_back(other);
    }
    CHECK(beside == expected);
  }
}

TEST_CASE("a point above a flat element is held by a better one beside it, where there is one") {
  TetMesh mesh;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 0.01}, {0.3, 0.3, -1}};
  mesh.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  mesh.regions = {0, 0};
  const Vec3 above(0.3, 0.3, 0.2);
  const ElementsAround both(mesh, full_topology(mesh));
  CHECK(both.weights(0, above).cwiseAbs().maxCoeff() == doctest::Approx(20));
  CHECK(both.suitable(0, above) == 1);
  CHECK(both.suitable(0, Vec3(0.3, 0.3, 0.005)) == 0);
  const ElementsAround alone(mesh, Topology{0, {0}});
  CHECK(alone.suitable(0, above) == 0);
  const Eigen::Vector4d w = both.weights(1, above);
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    sum += w[static_cast<int>(i)] * mesh.nodes[static_cast<std::size_t>(mesh.tets[1][i])];
  CHECK((sum - above).norm() < 1e-14);
  CHECK(w.sum() == doctest::Approx(1));
}

}  // namespace heml::elements_around_test
