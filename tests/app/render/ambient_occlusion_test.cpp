#include "app/render/ambient_occlusion.hpp"

#include <doctest/doctest.h>

#include "shapes.hpp"

namespace heml::ambient_occlusion_test {

using namespace heml::render;

TEST_CASE("a convex ball has no ambient occlusion") {
  const SurfaceMesh surface_mesh = ball_surface(2, 1);
  for (const float open : ambient_occlusion(surface_mesh, surface_mesh.rest, 0.7f)) CHECK(open == 1);
}

TEST_CASE("the inside of a closed ball is fully occluded") {
  const SurfaceMesh surface_mesh = ball_surface(2, 1);
  std::vector<Vec3f> inward;
  for (const Vec3f& node : surface_mesh.rest) inward.push_back(-node);
  for (const float open : ambient_occlusion(surface_mesh, inward, 3)) CHECK(open < 0.02f);
}

TEST_CASE("a wide wall occludes half of the hemisphere next to it") {
  // Nodes of a floor in the xz plane next to a wall in the xy plane. Half of the cosine-weighted directions about y
  // point to the side of the wall.
  SurfaceMesh surface_mesh;
  const float far = 200;
  surface_mesh.rest = {{0, 0, 1e-3f}, {1e-3f, 0, 1e-3f}, {0, 0, 2e-3f}, {-far, -1, 0}, {far, -1, 0}, {0, far, 0}};
  surface_mesh.triangles = {{3, 4, 5}};
  const std::vector<Vec3f> up(surface_mesh.rest.size(), Vec3f::UnitY());
  CHECK(ambient_occlusion(surface_mesh, up, 100)[0] == doctest::Approx(0.5).epsilon(0.06));
}

}  // namespace heml::ambient_occlusion_test
