#include "app/render/pick.hpp"

#include <doctest/doctest.h>

#include "shapes.hpp"

namespace heml::pick_test {

using namespace heml::render;

TEST_CASE("the pixel of a node in front picks that node, on the deformed body") {
  const Size size{640, 360};
  const SurfaceMesh surface_mesh = ball_surface(2, 0.05f);
  Frame frame = frame_at_rest(surface_mesh);
  for (Vec3f& node : frame.positions) node = Vec3f(1.3f * node.x(), 0.8f * node.y() + 0.01f, node.z());
  Camera camera;
  camera.fit(Vec3f::Zero(), 0.06f, size);
  int tried = 0;
  for (std::size_t i = 0; i < surface_mesh.rest.size(); ++i) {
    const Vec3f outward = surface_mesh.rest[i].cwiseQuotient(Vec3f(1.3f, 0.8f, 1)).normalized();
    const Vec3f to_eye = (camera.eye() - frame.positions[i]).normalized();
    if (outward.dot(to_eye) < 0.4f) continue;
    const Vec2f pixel = camera.pixel(frame.positions[i], size);
    // Slightly towards the middle of the picture, so that the ray does not pass exactly through an edge.
    const auto hit =
        pick(frame, surface_mesh, camera.ray(pixel.x() * 0.9999f + 0.032f, pixel.y() * 0.9999f + 0.018f, size));
    REQUIRE(hit);
    CHECK(hit->node == static_cast<int>(i));
    CHECK((hit->point - frame.positions[i]).norm() < 1e-3f);
    ++tried;
  }
  CHECK(tried > 30);
}

TEST_CASE("a ray past the body picks nothing and one through it the near side") {
  const SurfaceMesh surface_mesh = ball_surface(2, 1);
  const Frame frame = frame_at_rest(surface_mesh);
  CHECK_FALSE(pick(frame, surface_mesh, {Vec3f(0, 1.5f, 5), Vec3f(0, 0, -1)}));
  CHECK_FALSE(pick(frame, surface_mesh, {Vec3f(0.1f, 0.2f, 5), Vec3f(0, 0, 1)}));
  const auto hit = pick(frame, surface_mesh, {Vec3f(0.1f, 0.2f, 5), Vec3f(0, 0, -1)});
  REQUIRE(hit);
  CHECK(hit->point.z() == doctest::Approx(std::sqrt(1 - 0.05)).epsilon(0.02));
}

TEST_CASE("beyond a section plane nothing is picked, nor through its cap") {
  const SurfaceMesh surface_mesh = ball_surface(2, 1);
  const Frame frame = frame_at_rest(surface_mesh);
  const Ray from_front{Vec3f(0.1f, 0.2f, 5), Vec3f(0, 0, -1)}, from_behind{Vec3f(0.1f, 0.2f, -5), Vec3f(0, 0, 1)};
  const SectionPlane front_half{Vec3f::UnitZ(), 0};  // leaves out z > 0
  CHECK_FALSE(pick(frame, surface_mesh, from_front, front_half));
  const auto hit = pick(frame, surface_mesh, from_behind, front_half);
  REQUIRE(hit);
  CHECK(hit->point.z() < -0.9f);
  CHECK(pick(frame, surface_mesh, from_front, SectionPlane{Vec3f::UnitX(), 0.5f}));
  CHECK_FALSE(pick(frame, surface_mesh, from_front, SectionPlane{Vec3f::UnitX(), 0}));
}

TEST_CASE("the surface nearest to a point is found inside, outside and beside a square, within reach alone") {
  SurfaceMesh surface_mesh;
  surface_mesh.nodes = {20, 21, 22, 23};
  surface_mesh.rest = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  surface_mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Frame frame = frame_at_rest(surface_mesh);
  const auto find = [&](const Vec3f& point, float reach) { return nearest_surface(frame, surface_mesh, point, reach); };
  for (const float side : {1.0f, -1.0f}) {
    const auto hit = find({-0.7f, 0.5f, side * 0.3f}, 0.31f);
    REQUIRE(hit);
    CHECK(hit->triangle == 1);
    CHECK(hit->node == 3);
    CHECK((hit->point - Vec3f(-0.7f, 0.5f, 0)).norm() < 1e-6f);
    CHECK_FALSE(find({-0.7f, 0.5f, side * 0.3f}, 0.29f));
  }
  const auto corner = find({1.3f, -1.4f, 0}, 0.51f);
  REQUIRE(corner);
  CHECK((corner->point - Vec3f(1, -1, 0)).norm() < 1e-6f);
  CHECK(corner->node == 1);
  CHECK_FALSE(find({1.3f, -1.4f, 0}, 0.49f));
  CHECK(find({1, 1, 0}, 0));  // on a node
  const SectionPlane left_half{Vec3f::UnitX(), 0};
  CHECK(nearest_surface(frame, surface_mesh, {-0.1f, 0, 0}, 0.2f, left_half));
  CHECK_FALSE(nearest_surface(frame, surface_mesh, {0.3f, 0, 0}, 0.2f, left_half));
}

TEST_CASE("a field is interpolated between the nodes of the hit triangle if the frame has one") {
  const SurfaceMesh surface_mesh = ball_surface(2, 1);
  Frame frame = frame_at_rest(surface_mesh);
  const Ray ray{Vec3f(0.1f, 0.2f, 5), Vec3f(0, 0, -1)};
  const auto hit = pick(frame, surface_mesh, ray);
  REQUIRE(hit);
  CHECK_FALSE(value_at(*hit, frame, surface_mesh));
  frame.field = Field::displacement;
  CHECK_FALSE(value_at(*hit, frame, surface_mesh));  // the frame has no values yet
  for (const Vec3f& node : frame.positions) frame.values.push_back(3 * node.x() - node.y() + 1);
  const auto value = value_at(*hit, frame, surface_mesh);
  REQUIRE(value);
  CHECK(*value == doctest::Approx(3 * 0.1 - 0.2 + 1).epsilon(1e-5));
}

}  // namespace heml::pick_test
