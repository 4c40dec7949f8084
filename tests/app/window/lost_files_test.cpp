#include <doctest/doctest.h>

#include <app/window/lost_files.hpp>
#include <cstdlib>
#include <fstream>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <string>

#include "workplace.hpp"

namespace heml::lost_files_test {

using namespace heml::window;
namespace fs = std::filesystem;

namespace {

/// A working folder in a home, with a scene of a mesh file, that is opened by a relative path.
struct SceneInWorkplace : test::Workplace {
  SceneInWorkplace() {
    write_tet_mesh("body.msh", make_box(Vec3(0.1, 0.1, 0.1), {2, 1, 1}));
    std::ofstream("scene.json") << R"({"schema_version": 1, "name": "bar",
      "mesh": {"file": "body.msh", "scale": 2}, "materials": [{"law": "stvk", "young": 1e4, "poisson": 0.3}]})";
  }
};

}  // namespace

TEST_CASE("a scene whose files are there is saved as it is") {
  const SceneInWorkplace workplace;
  Scene scene = read_scene("scene.json");
  hold_files(scene);
  CHECK(scene.mesh.file == workplace.path / "body.msh");
  CHECK(keep_lost_files(scene).empty());
  CHECK(scene.mesh.file == workplace.path / "body.msh");
}

TEST_CASE("a scene whose folder is gone is saved with its mesh") {
  const SceneInWorkplace workplace;
  Scene scene = read_scene("scene.json");
  hold_files(scene);
  const TetMesh before = load_mesh(scene);
  fs::remove_all(workplace.path);
  const std::string told = keep_lost_files(scene);
  CHECK(told.find((workplace.path / "body.msh").string()) != std::string::npos);
  CHECK(scene.mesh.file.parent_path() == workplace.home);
  CHECK(told.find(scene.mesh.file.string()) != std::string::npos);
  const Scene saved = parse_scene(scene_text(scene, workplace.home), workplace.home / "saved.json");
  const TetMesh after = load_mesh(saved);
  CHECK(before.nodes == after.nodes);
  CHECK(before.tets == after.tets);
}

TEST_CASE("what cannot be written again is named") {
  const SceneInWorkplace workplace;
  Scene scene = read_scene("scene.json");
  scene.solver.quadratic = true;  // the file may have nodes on edges
  scene.initial_positions = "positions.csv";
  hold_files(scene);
  fs::remove_all(workplace.path);
  const std::string told = keep_lost_files(scene);
  for (const char* name : {"body.msh", "positions.csv"})
    CHECK(told.find((workplace.path / name).string() + " is gone") != std::string::npos);
  CHECK(scene.mesh.file == workplace.path / "body.msh");
}

}  // namespace heml::lost_files_test
