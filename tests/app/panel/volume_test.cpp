#include <doctest/doctest.h>

#include <app/panel/volume.hpp>

namespace heml::volume_test {

using panel::enclosed_volume;

namespace {
SurfaceMesh corner() {
  SurfaceMesh surface_mesh;
  surface_mesh.nodes = {0, 1, 2, 3};
  surface_mesh.rest = {{5, 5, 5}, {6, 5, 5}, {5, 6, 5}, {5, 5, 6}};
  surface_mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  return surface_mesh;
}
}  // namespace

TEST_CASE("a corner of a cube encloses a sixth of it") {
  const SurfaceMesh surface_mesh = corner();
  CHECK(enclosed_volume(surface_mesh) == doctest::Approx(1.0 / 6));
  std::vector<Vec3f> doubled = surface_mesh.rest;
  for (Vec3f& x : doubled) x *= 2;
  CHECK(enclosed_volume(surface_mesh, doubled) == doctest::Approx(8.0 / 6));
}

TEST_CASE("an inverted surface has negative volume and an empty one has none") {
  const SurfaceMesh surface_mesh = corner();
  std::vector<Vec3f> mirrored = surface_mesh.rest;
  for (Vec3f& x : mirrored) x.x() = -x.x();
  CHECK(enclosed_volume(surface_mesh, mirrored) == doctest::Approx(-1.0 / 6));
  CHECK(enclosed_volume(SurfaceMesh(), {}) == 0);
}

}  // namespace heml::volume_test
