#include "app/render/surface_point.hpp"

#include <doctest/doctest.h>

#include "shapes.hpp"

namespace heml::render {

TEST_CASE("a point of the surface moves with its triangle and is lost with a corner of it") {
  SurfaceMesh surface_mesh;
  surface_mesh.nodes = {3, 5, 8, 9};
  surface_mesh.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  surface_mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Frame frame = frame_at_rest(surface_mesh);
  const SurfacePoint point = surface_point({1, 3, {0.25f, 0.5f, 0}}, frame, surface_mesh);
  CHECK(point.nodes == std::array{3, 8, 9});
  const auto place = [&] { return point.among(*corners_of(point, frame, surface_mesh)); };
  CHECK((place() - Vec3f(0.25f, 0.5f, 0)).norm() < 1e-6f);
  frame.positions[3] += Vec3f(0, 0, 4);  // its weight there is 1/4
  CHECK((place() - Vec3f(0.25f, 0.5f, 1)).norm() < 1e-6f);
  surface_mesh.nodes = {3, 5, 9, 10};
  CHECK_FALSE(corners_of(point, frame, surface_mesh));
  CHECK_FALSE(surface_index(8, surface_mesh));
  CHECK(surface_index(9, surface_mesh) == 2u);
}

}  // namespace heml::render
