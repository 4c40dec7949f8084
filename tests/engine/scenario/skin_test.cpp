#include <doctest/doctest.h>

#include <heml/base/warning_collector.hpp>
#include <heml/scenario/load_mesh.hpp>
#include <heml/scenario/skin.hpp>

#include "engine/mesh/files.hpp"
#include "engine/mesh/helpers.hpp"
#include "engine/scenario/samples.hpp"

namespace heml::skin_test {

using namespace heml::test;

namespace {

// A pyramid in the box of the small scene, wound inward; with texture coordinates.
constexpr const char* pyramid =
    "v 0.05 0.02 0.02\nv 0.15 0.02 0.02\nv 0.1 0.08 0.05\nv 0.1 0.02 0.08\nvt 0 0\nvt 1 0\nvt 0 1\n"
    "f 1/1 2/2 3/3\nf 2/1 4/2 3/3\nf 4/1 1/2 3/3\nf 1/1 4/2 2/3\n";

struct Files {
  TemporaryFolder folder;
  std::string patch(const std::string& skin) const { return scene_with("{\"skin\": " + skin + "}"); }
  std::shared_ptr<const Skin> load(const std::string& skin, const std::string& mesh_key = "") const {
    Json json = Json::parse(patch(skin));
    if (!mesh_key.empty()) json["mesh"].merge_patch(Json::parse(mesh_key));
    const Scene scene = parse_scene(json.dump(), folder / "scene.json");
    return load_skin(scene, load_mesh(scene));
  }
  bool refuses(const std::string& skin, const std::string& part) const {
    const std::string message = refusal([&] { load(skin); });
    if (says(message, part)) return true;
    MESSAGE("'", message, "' does not say '", part, "'");
    return false;
  }
};

double volume(const TriangleMesh& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += signed_volume(Vec3::Zero(), surface.nodes[static_cast<std::size_t>(a)],
                         surface.nodes[static_cast<std::size_t>(b)], surface.nodes[static_cast<std::size_t>(c)]);
  return sum;
}

}  // namespace

TEST_CASE("a scene without a skin has none, and one with a skin keeps it") {
  const Scene none = small_scene_with("{}");
  CHECK(load_skin(none, load_mesh(none)) == nullptr);
  const Scene scene = small_scene_with(R"({"skin": {"file": "fine.obj", "texture": "fine.png"}})");
  REQUIRE(scene.skin);
  CHECK(scene.skin->file == "folder/fine.obj");
  CHECK(scene.skin->texture == "folder/fine.png");
  const Scene again = parse_scene(scene_text(scene, "folder"), "folder/other.json");
  CHECK(again.skin->file == scene.skin->file);
  CHECK(again.skin->texture == scene.skin->texture);
}

TEST_CASE("a skin is placed as the mesh is, turned outward, and embedded") {
  if (!reads_skins()) return;
  const Files files;
  files.folder.file("fine.obj", pyramid);
  const auto skin = files.load(R"({"file": "fine.obj"})");
  REQUIRE(skin);
  CHECK(skin->surface.mesh.triangles.size() == 4);
  CHECK(volume(skin->surface.mesh) > 0);
  CHECK(skin->embedding.size() == skin->surface.mesh.nodes.size());
  CHECK(skin->embedding.farthest == 0);
  const auto moved = files.load(R"({"file": "fine.obj"})", R"({"scale": 2, "translate": [1, 0, 0]})");
  for (std::size_t n = 0; n < skin->surface.mesh.nodes.size(); ++n)
    CHECK((moved->surface.mesh.nodes[n] - (2 * skin->surface.mesh.nodes[n] + Vec3(1, 0, 0))).norm() < 1e-12);
  CHECK(moved->embedding.farthest == 0);
}

TEST_CASE("a skin in another place than the body is warned of") {
  if (!reads_skins()) return;
  const Files files;
  files.folder.file("far.obj", "v 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n");
  const WarningCollector warnings;
  files.load(R"({"file": "far.obj"})");
  REQUIRE(warnings.texts().size() == 1);
  CHECK(says(warnings.texts()[0], "is the surface in the place and unit of the mesh?"));
}

TEST_CASE("missing and unfit files of a skin have one clear message") {
  if (!reads_skins()) return;
  const Files files;
  files.folder.file("fine.obj", pyramid);
  files.folder.file("plain.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n");
  files.folder.file("photo.png", "\xff\xd8\xff a JPEG by another name");
  CHECK(files.refuses(R"({"file": "gone.obj"})", "skin.file: there is no file"));
  CHECK(files.refuses(R"({"file": "fine.obj", "texture": "gone.png"})", "skin.texture: there is no file"));
  CHECK(files.refuses(R"({"file": "fine.obj", "texture": "photo.png"})", "photo.png' is no PNG image"));
  CHECK(files.refuses(R"({"file": "plain.obj", "texture": "photo.png"})", "the surface has no texture coordinates"));
  CHECK(files.refuses(R"({"file": "photo.png"})", "photo.png: is no surface"));
  CHECK(files.refuses(R"({"image": "fine.obj"})", "skin"));
}

}  // namespace heml::skin_test
