#include "app/render/ground_place.hpp"

#include <doctest/doctest.h>

namespace heml::ground_place_test {

using namespace heml::render;

namespace {

/// Two separate tetrahedra 1 m high, the first with a constrained node.
SurfaceMesh two_parts() {
  SurfaceMesh mesh;
  for (const float left : {0.0f, 3.0f})
    for (const Vec3f& corner : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)})
      mesh.rest.push_back(corner + left * Vec3f::UnitX());
  for (int node = 0; node < 8; ++node) mesh.nodes.push_back(node);
  for (const int first : {0, 4})
    for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{0, 3, 2}, Triangle{1, 2, 3}})
      mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  mesh.constrained = {2};
  return mesh;
}

}  // namespace

TEST_CASE("the ground stays under a body that falls, gives way to one that hangs, and is below tables") {
  const SurfaceMesh mesh = two_parts();
  const BoundingSphere rest = bounding_sphere(mesh.rest);
  const GroundPlace place(mesh);
  Frame frame;
  frame.positions = mesh.rest;
  const float at_rest = place.centre(frame, rest).y();
  CHECK(at_rest < 0);
  CHECK(at_rest > -0.2f * rest.radius);
  for (std::size_t k = 4; k < 8; ++k) frame.positions[k].y() -= 50;
  CHECK(place.centre(frame, rest).y() == at_rest);
  frame.positions[1].y() = -2;
  CHECK(place.centre(frame, rest).y() < -2);
  CHECK(GroundPlace(SurfaceMesh()).centre(Frame(), rest).y() == at_rest);

  frame.positions = mesh.rest;
  TableState table;
  table.table.point = Vec3(0, -3, 0);
  frame.tools.push_back(table);
  CHECK(place.centre(frame, rest).y() < -3);
  table.table.normal = Vec3::UnitX();  // a wall reaches below its middle
  frame.tools = {table};
  CHECK(place.centre(frame, rest).y() < -rest.radius);
}

}  // namespace heml::ground_place_test
