#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/selection.hpp>

namespace heml::default_scene_test {

TEST_CASE("the default scene of a bare mesh is soft tissue constrained at its top") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "beam.msh", make_box(Vec3(0.1, 0.2, 0.1), {1, 20, 1}));
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
  CHECK(setup.boundary[0].nodes.size() == 8);  // two layers of nodes, at y = 0.19 and 0.2
  for (const int node : setup.boundary[0].nodes) CHECK(setup.mesh.nodes[node].y() >= 0.2 * 0.92);
}

TEST_CASE("scales a body that cannot be meant in metres to 0.2 m, in the default scene only") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "liver.mesh", make_box(Vec3(100, 200, 100), {1, 20, 1}, Vec3(-500, 3, 3)));
  const Scene scene = scene_around(folder / "liver.mesh");
  const WorldSetup setup = load_setup(scene);
  const auto [low, high] = bounds_of(setup.mesh.nodes);
  CHECK((high - low).maxCoeff() == doctest::Approx(0.2).epsilon(1e-12));
  CHECK(setup.boundary[0].nodes.size() == 8);
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
    const std::string refused = refusal([&] { setup = load_setup(read_scene(path)); });
    if (refused.find("HEML_ASSIMP") != refused.npos || refused.find("HEML_TETGEN") != refused.npos) {
      MESSAGE("skipped: ", refused);  // this build cannot read surfaces
      continue;
    }
    REQUIRE(refused == "");
    const auto [low, high] = bounds_of(setup.mesh.nodes);
    CHECK((high - low).maxCoeff() <= 2);
    CHECK(!setup.boundary[0].nodes.empty());
    CHECK(setup.boundary[0].nodes.size() < setup.mesh.nodes.size() / 2);
    const double lowest = high.y() - 0.0801 * (high - low).y();
    for (const int node : setup.boundary[0].nodes) CHECK(setup.mesh.nodes[node].y() >= lowest);
  }
}

}  // namespace heml::default_scene_test
