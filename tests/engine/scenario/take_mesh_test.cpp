#include <doctest/doctest.h>

#include <engine/mesh/files.hpp>
#include <engine/mesh/solids.hpp>
#include <heml/base/warning_collector.hpp>
#include <heml/mesh/from_surface.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/write.hpp>
#include <heml/mesh/write_surface.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/take_mesh.hpp>

namespace heml::take_mesh_test {

namespace {

Scene scene_of(const std::filesystem::path& file, std::optional<int> tets) {
  Scene scene;
  scene.file = file.string();
  scene.chosen.emplace().given.tets = tets;
  take_mesh(scene, file);
  return scene;
}

/// 8 × 8 × 8 cells, flat ones below: most elements are slivers.
TetMesh flat_box() {
  TetMesh mesh = make_box(Vec3(0.1, 0.1, 0.1), {8, 8, 8});
  for (Vec3& x : mesh.nodes) x.y() *= (1 + 49 * (x.y() > 0.09)) / 50.0;
  return mesh;
}

/// Whether this build reads and fills surfaces; prints a message if not.
bool can_mesh() {
  const TemporaryFolder folder;
  write_surface(folder / "cube.obj", box_surface(Vec3(1, 1, 1), 1));
  const std::string said = refusal([&] { tetrahedralize(read_surface(folder / "cube.obj")); });
  if (!said.empty()) MESSAGE("skipped: ", said);
  return said.empty();
}

}  // namespace

TEST_CASE("without a wanted number a mesh stays as it is") {
  const TemporaryFolder folder;
  const TetMesh mesh = flat_box();
  write_tet_mesh(folder / "body.msh", mesh);
  const Scene scene = scene_of(folder / "body.msh", {});
  CHECK(scene.mesh.source->nodes == mesh.nodes);
  CHECK(scene.mesh.source->tets == mesh.tets);
  CHECK_FALSE(scene.mesh.tets);
  CHECK(scene.chosen->read_tets == 2560);
  CHECK(scene.chosen->tets == 2560);
  REQUIRE(scene.chosen->findings.size() == 1);
  CHECK(scene.chosen->findings[0].found == "slivers");
  CHECK(scene.chosen->findings[0].count > 2000);
  CHECK_FALSE(scene.chosen->findings[0].is_mended);
  CHECK(scene.chosen->min_dihedral < 5);
}

TEST_CASE("a mesh is made coarser or finer to the wanted number, its shapes better, its volume kept") {
  const TemporaryFolder folder;
  const TetMesh mesh = make_box(Vec3(0.1, 0.08, 0.06), {6, 6, 6});
  write_tet_mesh(folder / "body.msh", mesh);
  for (const int wanted : {300, 3000}) {
    CAPTURE(wanted);
    const Scene scene = scene_of(folder / "body.msh", wanted);
    CHECK(scene.mesh.tets == wanted);
    CHECK(scene.chosen->read_tets == 1080);
    CHECK(scene.chosen->tets == std::ssize(scene.mesh.source->tets));
    CHECK(scene.chosen->tets > 0.75 * wanted);
    CHECK(scene.chosen->tets < 1.25 * wanted);
    double volume = 0;
    for (const Tet& t : scene.mesh.source->tets) {
      const auto& x = scene.mesh.source->nodes;
      volume += signed_volume(x[t[0]], x[t[1]], x[t[2]], x[t[3]]);
    }
    CHECK(volume == doctest::Approx(0.1 * 0.08 * 0.06).epsilon(0.02));
  }
}

TEST_CASE("the wanted number is in the scene file and gives the same mesh to the bit") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "body.msh", flat_box());
  BareMeshOptions options;
  options.tets = 1500;
  const Scene scene = scene_around(folder / "body.msh", options);
  const Scene read = parse_scene(scene_text(scene), folder / "saved.json");
  CHECK(read.mesh.tets == 1500);
  CHECK_FALSE(read.mesh.source);
  const TetMesh before = load_mesh(scene), after = load_mesh(read);
  CHECK(before.tets.size() < 2000);
  CHECK(before.nodes == after.nodes);
  CHECK(before.tets == after.tets);
  CHECK(scene.chosen->min_dihedral > 5);
  REQUIRE(!scene.chosen->findings.empty());
  CHECK(scene.chosen->findings[0].is_mended);
  CHECK(scene.chosen->texts[0].about == "fineness");
}

TEST_CASE("a file that is taken again is not read again until it changes, and says the same") {
  const TemporaryFolder folder;
  write_tet_mesh(folder / "body.msh", flat_box());
  const Scene first = scene_of(folder / "body.msh", 1500), again = scene_of(folder / "body.msh", 1500);
  CHECK(first.mesh.source == again.mesh.source);
  CHECK(again.mesh.tets == 1500);
  CHECK(again.chosen->read_tets == 2560);
  CHECK(again.chosen->tets == first.chosen->tets);
  CHECK(again.chosen->min_dihedral == first.chosen->min_dihedral);
  CHECK(again.chosen->findings.size() == first.chosen->findings.size());
  CHECK(scene_of(folder / "body.msh", {}).mesh.source->tets.size() == 2560);
  write_tet_mesh(folder / "body.msh", make_box(Vec3(0.1, 0.1, 0.1), {2, 2, 2}));
  CHECK(scene_of(folder / "body.msh", {}).mesh.source->tets.size() == 40);
}

TEST_CASE("what was warned of a surface is warned again when it is taken again") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  TriangleMesh surface = box_surface(Vec3(0.1, 0.1, 0.1), 3);
  surface.triangles.pop_back();
  write_surface(folder / "open.obj", surface);
  for (int time = 0; time < 2; ++time) {
    const WarningCollector warnings;
    scene_of(folder / "open.obj", {});
    REQUIRE(!warnings.texts().empty());
    CHECK(warnings.texts()[0].find("closed 1 hole") != std::string::npos);
  }
}

TEST_CASE("a surface is filled coarser and finer than its triangles would have it") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  write_surface(folder / "ball.obj", box_surface(Vec3(0.1, 0.1, 0.1), 8));
  const int as_it_is = scene_of(folder / "ball.obj", {}).chosen->tets;
  for (const double times : {0.4, 3.0}) {
    const int wanted = static_cast<int>(times * as_it_is);
    const Scene scene = scene_of(folder / "ball.obj", wanted);
    CHECK(scene.chosen->tets > 0.7 * wanted);
    CHECK(scene.chosen->tets < 1.3 * wanted);
    const Scene read =
        parse_scene(scene_text(scene_around(folder / "ball.obj", scene.chosen->given)), folder / "saved.json");
    CHECK(std::ssize(load_mesh(read).tets) == scene.chosen->tets);
  }
}

TEST_CASE("holes of a surface are among the findings") {
  if (!can_mesh()) return;
  const TemporaryFolder folder;
  TriangleMesh surface = box_surface(Vec3(0.1, 0.1, 0.1), 6);
  surface.triangles.erase(surface.triangles.begin() + 3);
  write_surface(folder / "open.obj", surface);
  const Scene scene = scene_of(folder / "open.obj", {});
  REQUIRE(!scene.chosen->findings.empty());
  CHECK(scene.chosen->findings[0].found == "hole");
  CHECK(scene.chosen->findings[0].count == 1);
  CHECK(scene.chosen->findings[0].is_mended);
}

TEST_CASE("a box and an asset have their own number of tetrahedra") {
  const auto problem = [](const char* mesh) {
    return refusal([&] {
      parse_scene(std::string(R"({"schema_version": 1, "mesh": )") + mesh + R"(, "materials": []})", "scene.json");
    });
  };
  CHECK(problem(R"({"asset": "kidney", "tets": 100})").find("mesh.tets") != std::string::npos);
  CHECK(problem(R"({"box": {"size": [1, 1, 1], "cells": [1, 1, 1]}, "tets": 100})").find("mesh.tets") !=
        std::string::npos);
  CHECK(problem(R"({"file": "body.msh", "tets": 0})").find("mesh.tets") != std::string::npos);
}

}  // namespace heml::take_mesh_test
