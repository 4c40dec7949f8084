#include <doctest/doctest.h>

#include <heml/mesh/improve/local_mesh.hpp>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_local_mesh_test {

TEST_CASE("rings of edges are whole, closed inside and open at the surface, and part at interfaces") {
  const TetMesh start = test::shaken_box(4, 0.1);
  const LocalMesh mesh(start, ShapeMeasure());
  int closed = 0, open = 0, parted = 0;
  for (int t = 0; t < mesh.slots(); ++t)
    for (const auto& [i, j] : tet_edges) {
      const int a = mesh.tet(t)[i], b = mesh.tet(t)[j];
      const auto sectors = mesh.ring(a, b);
      REQUIRE(!sectors.empty());
      for (const RingSector& sector : sectors) {
        CHECK(sector.nodes.size() == sector.tets.size() + (sector.is_closed ? 0 : 1));
        for (std::size_t k = 0; k < sector.tets.size(); ++k) {
          const int r = sector.nodes[k], s = sector.nodes[(k + 1) % sector.nodes.size()];
          CHECK(signed_volume(mesh.node(a), mesh.node(b), mesh.node(r), mesh.node(s)) > 0);
        }
      }
      closed += sectors.front().is_closed;
      open += sectors.size() == 1 && !sectors.front().is_closed;
      parted += sectors.size() == 2;
    }
  CHECK(closed > 0);
  CHECK(open > 0);
  CHECK(parted > 0);
}

TEST_CASE("replacing elements and taking it back leaves neighbours and surface as they were") {
  const TetMesh start = test::shaken_box(3, 0.1);
  LocalMesh mesh(start, ShapeMeasure());
  const int t = 5;
  const RegionTet old{mesh.tet(t), mesh.region(t)};
  const int count = mesh.count();
  mesh.replace(std::array{t}, {});
  CHECK(mesh.count() == count - 1);
  CHECK_FALSE(mesh.exists(t));
  mesh.replace({}, std::array{old});
  CHECK(mesh.count() == count);
  test::check_same_body(start, mesh.extract("test"));
}

TEST_CASE("nodes without elements are left out, regions kept") {
  TetMesh start = make_box(Vec3::Ones(), {1, 1, 1});
  start.nodes.emplace_back(5, 5, 5);
  start.regions.assign(start.tets.size(), -3);
  const TetMesh same = LocalMesh(start, ShapeMeasure()).extract("name");
  CHECK(same.nodes.size() == 8);
  CHECK(same.regions == start.regions);
  CHECK(same.source == "name");
}

}  // namespace heml::improve_local_mesh_test
