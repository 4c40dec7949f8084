#include <doctest/doctest.h>

#include <heml/mesh/untangle.hpp>

#include "engine/mesh/solids.hpp"

namespace heml::untangle_test {

TEST_CASE("smooths a crease apart and leaves all nodes away from it as they were") {
  TriangleMesh surface = creased_box();
  const TriangleMesh before = surface;
  const Intersections found = self_intersections(surface);
  REQUIRE(found.pairs > 0);
  CHECK(untangle(surface, found));
  CHECK(self_intersections(surface).pairs == 0);
  for (std::size_t n = 0; n < surface.nodes.size(); ++n)
    if ((before.nodes[n] - Vec3(0.5, 0.5, 1)).norm() > 0.5) CHECK(surface.nodes[n] == before.nodes[n]);
}

TEST_CASE("leaves bodies that cross as they were") {
  TriangleMesh surface = together(cube(1, Vec3(0, 0, 0)), cube(1, Vec3(0.3, 0.31, 0.32)));
  const std::vector<Vec3> before = surface.nodes;
  CHECK_FALSE(untangle(surface, self_intersections(surface)));
  CHECK(surface.nodes == before);
}

}  // namespace heml::untangle_test
