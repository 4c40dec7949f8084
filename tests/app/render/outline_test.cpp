#include "app/render/outline.hpp"

#include <doctest/doctest.h>

#include <app/render/camera.hpp>
#include <heml/mesh/weld.hpp>

#include "shapes.hpp"

namespace heml::outline_test {

using namespace heml::render;

namespace {

std::vector<std::uint32_t> indices_of(const SurfaceMesh& surface_mesh) {
  std::vector<std::uint32_t> indices;
  for (const Triangle& triangle : surface_mesh.triangles)
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  return indices;
}

}  // namespace

TEST_CASE("the outline of a cube seen along an axis is its four front edges") {
  const Size size{400, 400};
  const SurfaceMesh surface_mesh = cube_surface();
  Camera camera;
  camera.fit(Vec3f::Zero(), 1, size);
  camera.look(0, 0);
  Outline outline(indices_of(surface_mesh), weld(surface_mesh.rest));
  const auto& pieces = outline.find(surface_mesh.rest, camera.eye(), camera.projection(size) * camera.view(), size);
  REQUIRE(pieces.size() == 4);
  for (const auto& piece : pieces) {
    const Vec3f middle = (surface_mesh.rest[piece.from] + surface_mesh.rest[piece.to]) / 2;
    CHECK(middle.z() == 0.5f);
    CHECK(piece.outward.dot(middle.head<2>()) > 0);
    CHECK(piece.outward.norm() == doctest::Approx(2.0 / 400));  // one pixel; the picture is 2 wide in clip space
  }
}

TEST_CASE("the outline of a ball is a closed loop round its rim") {
  const Size size{400, 300};
  const SurfaceMesh surface_mesh = ball_surface(3, 1);
  Camera camera;
  camera.fit(Vec3f::Zero(), 1, size);
  Outline outline(indices_of(surface_mesh), weld(surface_mesh.rest));
  const auto& pieces = outline.find(surface_mesh.rest, camera.eye(), camera.projection(size) * camera.view(), size);
  std::map<std::uint32_t, int> ends;
  for (const auto& piece : pieces) {
    ++ends[piece.from];
    ++ends[piece.to];
    const Vec3f place = surface_mesh.rest[piece.from];
    CHECK(std::abs(place.dot(camera.eye() - place)) < 0.25f * camera.eye().norm());  // near the silhouette
  }
  CHECK(pieces.size() > 20);
  for (const auto& [vertex, count] : ends) CHECK(count % 2 == 0);
}

}  // namespace heml::outline_test
