#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <engine/mesh/files.hpp>
#include <engine/scenario/samples.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/scenario/schedule.hpp>
#include <heml/scenario/selection.hpp>

namespace heml::load_test {
namespace {

// The small scene's box: nodes at x = 0, 0.1, 0.2; y, z = 0, 0.1; numbered with x fastest, then y, then z.
WorldSetup setup_with(const std::string& patch) { return load_setup(test::small_scene_with(patch)); }
std::string refusal_of(const std::string& patch) {
  return refusal([&] { setup_with(patch); });
}

}  // namespace

TEST_CASE("selects nodes by number, box and sphere, boundaries of the sets included") {
  const WorldSetup setup = setup_with(R"({"boundary": [
    {"nodes": [7, 3, 7], "fix": true},
    {"box": [[0.2, 0, 0], [0.2, 0.1, 0.05]], "translate": [0.01, 0, 0]},
    {"sphere": [[0, 0, 0], 0.1], "fix": true}
  ]})");
  CHECK(setup.boundary[0].nodes == std::vector<int>{3, 7});
  CHECK(setup.boundary[1].nodes == std::vector<int>{2, 5});
  CHECK(setup.boundary[1].translate == Vec3(0.01, 0, 0));
  CHECK(setup.boundary[2].nodes == std::vector<int>{0, 1, 3, 6});
}

TEST_CASE("selects after scaling, turning and moving, in this order") {
  const WorldSetup setup = setup_with(R"({
    "mesh": {"scale": 10, "rotate": {"axis": [0, 0, 1], "origin": [1, 0, 0], "degrees": 90}, "translate": [0, 0, 5]},
    "boundary": [{"sphere": [[1, 1, 5], 1e-9], "fix": true}]})");
  // node 2: (0.2, 0, 0) -> (2, 0, 0) -> (1, 1, 0) -> (1, 1, 5)
  CHECK(setup.boundary[0].nodes == std::vector<int>{2});
  CHECK((setup.mesh.nodes[0] - Vec3(1, -1, 5)).norm() < 1e-15);
}

TEST_CASE("refuses a selection of nothing with its key path and where the body is") {
  CHECK(refusal_of(R"({"boundary": [{"nodes": [0], "fix": true}, {"box": [[1, 1, 1], [2, 2, 2]], "fix": true}]})")
            .find("folder/scene.json: boundary[1]: its box selects no node "
                  "(the body reaches from [0, 0, 0] to [0.2, 0.1, 0.1] m)") == 0);
  CHECK(says(refusal_of(R"({"loads": [{"sphere": [[9, 9, 9], 0.1], "force": [0, 0, 1]}]})"),
                   "loads[0]: its sphere selects"));
  CHECK(says(refusal_of(R"({"boundary": [{"nodes": [0, 12], "fix": true}]})"),
                   "boundary[0].nodes[1]: is 12 (the mesh has nodes 0 to 11)"));
  CHECK(
      says(refusal_of(R"({"loads": [{"nodes": [0, 1], "pressure": 3}]})"), "loads[0]: its 2 nodes hold no face"));
  CHECK(refusal_of(R"({"loads": [{"nodes": [0, 1], "force": [0, 0, 3]}]})").empty());
}

TEST_CASE("refuses meshes that are not there, naming the key") {
  CHECK(refusal_of(R"({"mesh": {"box": null, "file": "none.msh"}})")
            .find("folder/scene.json: mesh.file: there is no file 'folder/none.msh'") == 0);
  CHECK(says(refusal_of(R"({"mesh": {"box": null, "surface": "none.stl"}})"), "mesh.surface: there is no file"));
  CHECK(says(refusal_of(R"({"mesh": {"box": null, "asset": "spleen"}})"), "mesh.asset: 'spleen' is not in"));
}

TEST_CASE("takes assets from the folder the environment names") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "meshes");
  write_tet_mesh(folder / "meshes/cube.mesh", make_box(Vec3(1, 1, 1), {1, 1, 1}));
  setenv("HEML_ASSETS", (folder / "").c_str(), 1);
  CHECK(setup_with(R"({"mesh": {"box": null, "asset": "cube"}, "boundary": []})").mesh.tets.size() == 5);
  CHECK(says(refusal_of(R"({"mesh": {"box": null, "asset": "spleen"}})"), "there are: cube"));
  unsetenv("HEML_ASSETS");
  CHECK(std::filesystem::is_directory(assets_folder()));
}

TEST_CASE("reads initial positions of every node, in any order") {
  const TemporaryFolder folder;
  std::string lines;
  for (int node = 11; node >= 0; --node) lines += std::to_string(node) + ", 0.5," + std::to_string(node) + ",-1e-3\n";
  const auto load = [&](const std::string& text) {
    const std::string file = folder.file("start.csv", text).string();
    return setup_with("{\"initial\": {\"positions\": \"" + file + "\"}}").initial_positions;
  };
  const auto message = [&](const std::string& text) { return refusal([&] { load(text); }); };
  const std::vector<Vec3> positions = load("node,x,y,z\r\n" + lines + "\n");
  CHECK(load("\xEF\xBB\xBFnode,x,y,z\n" + lines) == positions);
  REQUIRE(positions.size() == 12);
  for (int node = 0; node < 12; ++node) CHECK(positions[node] == Vec3(0.5, node, -1e-3));
  CHECK(says(message("node,x,y\n"), "start.csv: line 1: is 'node,x,y' (must be the header node,x,y,z)"));
  CHECK(says(message("node,x,y,z\n" + lines + "3,0,0,0\n"), "line 14: is of node 3 once more"));
  CHECK(says(message("node,x,y,z\n12,0,0,0\n"), "line 2: is of node 12 (the mesh has nodes 0 to 11)"));
  for (const char* line : {"0,0,0", "0,0,0,0,0", "0,0,x,0", "0,nan,0,0", "0,0,0,inf", "0.5,0,0,0", "0,0,0,"})
    CHECK(says(message(std::string("node,x,y,z\n") + line + "\n"), "line 2: is '"));
  CHECK(says(message("node,x,y,z\n0,0,0,0\n"), "start.csv: gives 1 of 12 nodes"));
}

TEST_CASE("refuses a recording on another mesh than its own") {
  Scene scene = test::small_scene_with("{}");
  scene.recorded_mesh = mesh_fingerprint(load_setup(scene).mesh);
  CHECK(refusal([&] { load_setup(scene); }).empty());
  scene.mesh.translate.x() = 1e-9;
  scene.boundary.clear();
  CHECK(says(refusal([&] { load_setup(scene); }),
                   "recorded: was recorded on a mesh of 12 nodes and 10 tetrahedra (hash"));
}

TEST_CASE("finds the mesh of a moved recording beside it, and of a plain scene only where it says") {
  const TemporaryFolder folder;
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  write_tet_mesh(folder / "cube.msh", mesh);
  Scene scene = test::small_scene_with(R"({"mesh": {"box": null, "file": "/gone/cube.msh"}, "boundary": []})");
  scene.file = (folder / "recording.jsonl").string();
  CHECK(says(refusal([&] { load_setup(scene); }), "there is no file '/gone/cube.msh'"));
  scene.recorded_mesh = mesh_fingerprint(mesh);
  CHECK(load_setup(scene).mesh.tets.size() == 5);
}

TEST_CASE("resolves a grasp of a place to the surface node nearest at rest, and refuses nodes the mesh has not") {
  Scene scene = test::small_scene_with(R"({"events": [
    {"step": 2, "grasp": {"point": [0.19, 0.08, 0.3], "radius": 0.01}}, {"step": 1, "grasp": {"node": 4}}]})");
  const TetMesh mesh = load_setup(scene).mesh;
  Schedule schedule(scene, mesh);
  CHECK(schedule.due(0).empty());
  REQUIRE(schedule.due(1).size() == 1);
  REQUIRE(schedule.due(2).size() == 1);
  CHECK(schedule.due(2).empty());
  CHECK(nearest_surface_node(mesh, Vec3(0.19, 0.08, 0.3)) == 11);
  std::get<Grasp>(scene.events[0].command).node = 12;
  CHECK(says(refusal([&] { Schedule(scene, mesh); }), "events: step 1: grasp.node: is 12"));
}

}  // namespace heml::load_test
