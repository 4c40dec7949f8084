#include <doctest/doctest.h>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_surface_tree_test {

TEST_CASE("the nearest point is that of a search through all triangles") {
  const SurfaceTree tree(constrained_surface(test::shaken_box(4, 0.2)));
  std::mt19937_64 random(5);
  for (int k = 0; k < 200; ++k) {
    const Vec3 x = Vec3::Constant(0.05) + test::random_vector(random, 0.1);
    double nearest = 1e9;
    for (int t = 0; t < static_cast<int>(tree.surface().triangles.size()); ++t)
      nearest = std::min(nearest, (nearest_on_triangle(x, tree.corners(t)) - x).norm());
    CHECK(tree.nearest(x).distance == doctest::Approx(nearest));
    CHECK(tree.is_within(x, 1.001 * nearest + 1e-12));
    CHECK_FALSE(tree.is_within(x, 0.999 * nearest - 1e-12));
  }
}

TEST_CASE("the surface of regions holds the boundary and the interface once") {
  CHECK(test::area_of(constrained_surface(test::shaken_box(4, 0.2))) == doctest::Approx(7 * 0.01));
}

TEST_CASE("the distance of two surfaces counts both ways") {
  const TriangleMesh small{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, "small"};
  const TriangleMesh large{{{0, 0, 0}, {3, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, "large"};
  CHECK(surface_distance(SurfaceTree(small), SurfaceTree(large)) == doctest::Approx(2));
  CHECK(surface_distance(SurfaceTree(large), SurfaceTree(small)) == doctest::Approx(2));
  CHECK(surface_distance(SurfaceTree(small), SurfaceTree(small)) < 1e-12);
}

}  // namespace heml::improve_surface_tree_test
