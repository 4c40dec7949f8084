#include <doctest/doctest.h>

#include <heml/mesh/textured_surface.hpp>
#include <messages.hpp>

#include "engine/mesh/files.hpp"
#include "engine/mesh/helpers.hpp"

namespace heml::textured_surface_test {

namespace {

constexpr const char* square =
    "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.25\nusemtl skin\n"
    "f 1/1 2/2 3/3\nf 1/5 3/3 4/4\n";

}  // namespace

TEST_CASE("a surface has its texture coordinates, seams apart, and the image beside it") {
  if (!reads_skins()) return;
  const TemporaryFolder folder;
  folder.file("s.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd C:\\elsewhere\\skin.png\n");
  folder.file("skin.png", "an image");
  const TexturedSurface surface = read_textured_surface(folder.file("s.obj", square));
  CHECK(surface.mesh.triangles.size() == 2);
  CHECK(surface.mesh.nodes.size() == 5);  // the corner of both triangles is one vertex, that of a seam two
  CHECK(surface.texture == folder / "skin.png");
  REQUIRE(surface.places.size() == surface.mesh.nodes.size());
  // Each corner of the file is found, with the node and the place that it names.
  const std::vector<std::pair<Vec3, std::array<float, 2>>> corners{
      {{0, 0, 0}, {0, 0}}, {{1, 0, 0}, {1, 0}}, {{1, 1, 0}, {1, 1}}, {{0, 0, 0}, {0.5f, 0.25f}}, {{0, 1, 0}, {0, 1}}};
  for (const auto& [x, place] : corners) {
    bool found = false;
    for (std::size_t n = 0; n < surface.mesh.nodes.size(); ++n)
      found = found || (surface.mesh.nodes[n] == x && surface.places[n] == place);
    CHECK(found);
  }
}

TEST_CASE("a missing image is refused with its name, unless the scene names another") {
  if (!reads_skins()) return;
  const TemporaryFolder folder;
  folder.file("s.mtl", "newmtl skin\nmap_Kd gone.png\n");
  const auto file = folder.file("s.obj", square);
  CHECK(says(refusal([&] { read_textured_surface(file); }), "names the texture 'gone.png', which is not there"));
  CHECK(read_textured_surface(file, false).texture.empty());
}

TEST_CASE("colours are those of vertices or materials, and none where the file gives none") {
  if (!reads_skins()) return;
  const TemporaryFolder folder;
  const TexturedSurface painted =
      read_textured_surface(folder.file("p.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0.5\nf 1 2 3\n"));
  REQUIRE(painted.colours.size() == painted.mesh.nodes.size());
  for (std::size_t n = 0; n < painted.mesh.nodes.size(); ++n)
    if (painted.mesh.nodes[n].x() == 1) CHECK(painted.colours[n] == Vec3f(0, 1, 0));
  folder.file("m.mtl", "newmtl red\nKd 0.8 0.1 0.1\n");
  const TexturedSurface red =
      read_textured_surface(folder.file("m.obj", "mtllib m.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  REQUIRE(red.colours.size() == 3);
  CHECK((red.colours[0] - Vec3f(0.8f, 0.1f, 0.1f)).norm() < 1e-6f);
  const TexturedSurface plain = read_textured_surface(folder.file("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  CHECK(plain.colours.empty());
  CHECK(plain.places.empty());
  CHECK(plain.texture.empty());
}

TEST_CASE("what is no surface is refused by its name") {
  if (!reads_skins()) return;
  const TemporaryFolder folder;
  CHECK(says(refusal([&] { read_textured_surface(folder / "none.obj"); }), "none.obj: there is no such file"));
  CHECK(says(refusal([&] { read_textured_surface(folder.file("a.obj", "v 0 0 0\n")); }), "a.obj"));
}

}  // namespace heml::textured_surface_test
