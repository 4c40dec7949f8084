#include "app/render/camera.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

namespace heml::camera_test {

using namespace heml::render;

TEST_CASE("a fitted camera shows the whole ball at a useful size") {
  for (const Size size : {Size{1280, 720}, Size{640, 640}, Size{300, 900}}) {
    const Vec3f centre(0.2f, -0.1f, 0.4f);
    const float radius = 0.07f;
    Camera camera;
    camera.fit(centre, radius, size);
    const Vec2f middle = camera.pixel(centre, size);
    CHECK(middle.x() == doctest::Approx(size.width / 2.0));
    CHECK(middle.y() == doctest::Approx(size.height / 2.0));
    const float reach = (camera.pixel(centre + radius * camera.right(), size) - middle).norm();
    const float room = static_cast<float>(std::min(size.width, size.height)) / 2;
    CHECK(reach < room);
    CHECK(reach > 0.6f * room);
  }
}

TEST_CASE("the ray of a pixel passes through the points seen there") {
  const Size size{640, 360};
  Camera camera;
  camera.fit({0.1f, 0, 0}, 0.5f, size);
  camera.orbit(0.7f, -0.2f);
  camera.pan(0.1f, 0.05f);
  const Vec3f point(0.2f, 0.1f, -0.15f);
  const Vec2f pixel = camera.pixel(point, size);
  const Ray ray = camera.ray(pixel.x(), pixel.y(), size);
  const Vec3f beside = (point - ray.origin) - (point - ray.origin).dot(ray.direction) * ray.direction;
  CHECK(beside.norm() < 1e-5f);
  CHECK((camera.drag(pixel.x(), pixel.y(), size, point) - point).norm() < 1e-5f);
}

TEST_CASE("dragging stays in the plane that faces the camera") {
  const Size size{640, 360};
  Camera camera;
  camera.fit(Vec3f::Zero(), 1, size);
  const Vec3f point(0.3f, 0.2f, 0.1f);
  const Vec3f moved = camera.drag(100, 300, size, point) - point;
  CHECK(std::abs(moved.dot(camera.right().cross(camera.up()))) < 1e-5f);
  const Vec2f pixel = camera.pixel(point + moved, size);
  CHECK(pixel.x() == doctest::Approx(100).epsilon(1e-4));
  CHECK(pixel.y() == doctest::Approx(300).epsilon(1e-4));
}

TEST_CASE("orbiting keeps the distance and stops short of the poles") {
  Camera camera;
  camera.fit(Vec3f::Zero(), 1, {100, 100});
  const float distance = camera.eye().norm();
  camera.orbit(10, 10);
  CHECK(camera.eye().norm() == doctest::Approx(distance));
  CHECK(camera.up().y() > 0);
  CHECK(camera.eye().y() / distance == doctest::Approx(std::sin(89 * std::numbers::pi / 180)));
}

}  // namespace heml::camera_test
