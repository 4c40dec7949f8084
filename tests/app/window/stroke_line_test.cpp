#include "app/window/stroke_line.hpp"

#include <doctest/doctest.h>

namespace heml::stroke_line_test {

using window::StrokeLine;

TEST_CASE("the line lies on the skin, moves with it, breaks where the blade left it and ends where tissue parts") {
  SurfaceMesh surface_mesh;
  surface_mesh.nodes = {3, 5, 8, 9};
  surface_mesh.rest = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  surface_mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  Frame frame;
  frame.positions = surface_mesh.rest;
  StrokeLine line;
  const auto add = [&](int triangle, const Vec3f& point) { line.add({triangle, 0, point}, frame, surface_mesh); };
  add(0, {0.8f, 0.1f, 0});
  CHECK(line.segments(frame, surface_mesh).empty());
  add(0, {0.6f, 0.4f, 0});
  add(1, {0.3f, 0.6f, 0});
  auto segments = line.segments(frame, surface_mesh);
  REQUIRE(segments.size() == 2);
  CHECK((segments[0][0] - Vec3f(0.8f, 0.1f, 0)).norm() < 1e-6f);
  CHECK((segments[1][1] - Vec3f(0.3f, 0.6f, 0)).norm() < 1e-6f);

  line.lift();
  add(1, {0.1f, 0.9f, 0});
  add(1, {0.1f, 0.8f, 0});
  CHECK(line.segments(frame, surface_mesh).size() == 3);

  for (Vec3f& x : frame.positions) x += Vec3f(0, 0, 2);
  CHECK((line.segments(frame, surface_mesh)[0][0] - Vec3f(0.8f, 0.1f, 2)).norm() < 1e-6f);
  frame.positions[3] += Vec3f(-2, 0, 0);  // the second triangle has come apart
  CHECK(line.segments(frame, surface_mesh).size() == 1);
  surface_mesh.nodes = {3, 5, 9, 10};  // a node is gone from the surface
  CHECK(line.segments(frame, surface_mesh).empty());
  line.clear();
  CHECK(line.segments(frame, surface_mesh).empty());
}

}  // namespace heml::stroke_line_test
