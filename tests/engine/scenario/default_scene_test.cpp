#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/selection.hpp>

namespace heml::default_scene_test {

TEST_CASE("the default scene of a bare mesh is soft tissue that rests on its underside") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "beam.msh", make_box(Vec3(0.1, 0.1, 0.1), {1, 10, 1}));
  const Scene scene = read_scene(folder / "beam.msh");
  CHECK(scene.name == "beam");
  CHECK(scene.mesh.scale == 1);
  CHECK(scene.materials[0].material.law == "neo_hookean");
  CHECK(scene.materials[0].material.density == 1000);
  const std::vector<double>& parameters = scene.materials[0].material.parameters;
  const EngineeringConstants constants = engineering_constants({parameters[0], parameters[1]});
  CHECK(constants.young == doctest::Approx(1e4).epsilon(1e-12));
  CHECK(constants.poisson == doctest::Approx(0.45).epsilon(1e-12));
  CHECK(scene.gravity == Vec3(0, -9.81, 0));
  CHECK(scene.solver.continuation);
  CHECK(scene.solver.damping == 1);
  const WorldSetup setup = load_setup(scene);
  REQUIRE(setup.boundary.size() == 1);
  CHECK(setup.boundary[0].nodes.size() == 9);  // the layer at y = 0, of quadratic elements
  for (const int node : setup.boundary[0].nodes) CHECK(setup.mesh.nodes[node].y() == 0);
}

TEST_CASE("a body that cannot be meant in metres is read in the unit that makes it an organ's size") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "liver.mesh", make_box(Vec3(200, 100, 100), {20, 1, 1}, Vec3(-500, 3, 3)));
  const Scene scene = scene_around(folder / "liver.mesh");
  const WorldSetup setup = load_setup(scene);
  const auto [low, high] = bounds_of(setup.mesh.nodes);
  CHECK((high - low).maxCoeff() == doctest::Approx(0.2).epsilon(1e-12));
  CHECK(scene.chosen->unit == "millimetres");
}

TEST_CASE("regions that a mesh file names get a material each, others share one") {
  const TemporaryFolder folder;
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = t < 20 ? 4 : 7;
  write_tet_mesh(folder / "plain.msh", mesh);
  mesh.region_names = {{4, "liver"}, {7, "tumour"}};
  write_tet_mesh(folder / "named.msh", mesh);
  CHECK(scene_around(folder / "plain.msh").materials.size() == 1);
  const Scene scene = scene_around(folder / "named.msh");
  REQUIRE(scene.materials.size() == 2);
  CHECK(scene.materials[0].region == 4);
  CHECK(scene.materials[1].region == 7);
  CHECK(load_setup(scene).mesh.region_names == mesh.region_names);
}

TEST_CASE("the scene of a bare mesh is the same whenever it is made, and reads the mesh once") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "block.msh", make_box(Vec3(0.1, 0.1, 0.1), {4, 4, 4}));
  const Scene one = scene_around(folder / "block.msh"), other = scene_around(folder / "block.msh");
  CHECK(scene_text(one) == scene_text(other));
  std::filesystem::remove(folder / "block.msh");
  CHECK(load_setup(one).mesh.tets.size() == 320);
}

TEST_CASE("puts a scene round meshes and surfaces made by others") {
  for (const char* name : {"liver2.msh", "liver_small.mesh", "liver-smooth.obj"}) {
    const std::filesystem::path path = shared_data(name);
    if (path.empty()) {
      MESSAGE("skipped: ", name, " is not there");
      continue;
    }
    CAPTURE(name);
    WorldSetup setup;
    Scene scene;
    const std::string refused = refusal([&] {
      scene = read_scene(path);
      setup = load_setup(scene);
    });
    if (refused.find("HEML_ASSIMP") != refused.npos || refused.find("HEML_TETGEN") != refused.npos) {
      MESSAGE("skipped: ", refused);  // this build cannot read surfaces
      continue;
    }
    REQUIRE(refused == "");
    const auto [low, high] = bounds_of(setup.mesh.nodes);
    CHECK((high - low).maxCoeff() <= 2);
    CHECK(!setup.boundary[0].nodes.empty());
    CHECK(setup.boundary[0].nodes.size() < setup.mesh.nodes.size() / 2);
    CHECK(scene.chosen->load <= 0.7);
    CHECK(scene.chosen->stretch <= 1.5);
  }
}

}  // namespace heml::default_scene_test
