#include <doctest/doctest.h>

#include <app/window/elements_around.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/session/surface_mesh.hpp>

namespace heml::elements_around_test {

using namespace heml::window;

TEST_CASE("the elements round a node are those it has on the surface, and those within the radius") {
  WorldSetup setup;
  setup.mesh = make_box(Vec3(0.08, 0.02, 0.02), {8, 2, 2});
  setup.materials = {{std::nullopt, {"stvk", {2e4, 1e4}, 1000}}};
  const auto world = make_world(setup);
  const auto surface_mesh = make_surface_mesh(*world);
  const int corner = 0;
  const auto touching = elements_around(corner, *surface_mesh, 0);
  REQUIRE_FALSE(touching.empty());
  for (const int t : touching) {
    const Tet& tet = setup.mesh.tets[static_cast<std::size_t>(t)];
    CHECK(std::find(tet.begin(), tet.end(), corner) != tet.end());
  }
  const auto wide = elements_around(corner, *surface_mesh, 0.03);
  CHECK(wide.size() > touching.size());
  CHECK(std::includes(wide.begin(), wide.end(), touching.begin(), touching.end()));
  for (const int t : wide)
    for (const int n : setup.mesh.tets[static_cast<std::size_t>(t)])
      CHECK(setup.mesh.nodes[static_cast<std::size_t>(n)].x() < 0.0501);
  CHECK(elements_around(-1, *surface_mesh, 1).empty());

  // Each removal exposes the next layer, until no element is left at the node.
  auto next = surface_mesh;
  for (int layer = 0; layer < 4 && !elements_around(corner, *next, 0).empty(); ++layer) {
    const auto gone = elements_around(corner, *next, 0);
    REQUIRE(world->apply(RemoveElements{{gone, {}, {}, {}}}).ok());
    next = make_surface_mesh(*world, next);
    CHECK(next->version == surface_mesh->version + layer + 1);
    CHECK(next->whole == surface_mesh);
    for (const int t : gone) CHECK(std::find(next->elements.begin(), next->elements.end(), t) == next->elements.end());
    CHECK(make_surface_mesh(*world, next) == next);
  }
  CHECK(std::find(next->nodes.begin(), next->nodes.end(), corner) == next->nodes.end());
  CHECK(elements_around(corner, *next, 1).empty());
}

}  // namespace heml::elements_around_test
