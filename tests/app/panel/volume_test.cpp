#include <doctest/doctest.h>

#include <app/panel/volume.hpp>

namespace heml::volume_test {

using panel::enclosed_volume;

namespace {
Skin corner() {
  Skin skin;
  skin.nodes = {0, 1, 2, 3};
  skin.rest = {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {5, 5, 6}};
  skin.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return skin;
}
}  // namespace

TEST_CASE("a corner of a cube encloses a sixth of it") {
  const Skin skin = corner();
  CHECK(enclosed_volume(skin) == doctest::Approx(1.0 / 6));
  std::vector<Vec3f> doubled = skin.rest;
  for (Vec3f& x : doubled) x *= 2;
  CHECK(enclosed_volume(skin, doubled) == doctest::Approx(8.0 / 6));
}

TEST_CASE("what is turned inside out counts negative, and nothing encloses nothing") {
  const Skin skin = corner();
  std::vector<Vec3f> mirrored = skin.rest;
  for (Vec3f& x : mirrored) x.x() = -x.x();
  CHECK(enclosed_volume(skin, mirrored) == doctest::Approx(-1.0 / 6));
  CHECK(enclosed_volume(Skin(), {}) == 0);
}

}  // namespace heml::volume_test
