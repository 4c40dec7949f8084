#include "app/render/camera.hpp"

#include <doctest/doctest.h>

#include <cmath>

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

TEST_CASE("an orthographic camera shows lengths across it alike at every depth, and at the target as in perspective") {
  const Size size{640, 360};
  Camera camera;
  camera.fit({0.1f, 0.2f, 0}, 0.5f, size);
  camera.orbit(0.7f, -0.2f);
  const Vec3f across = 0.1f * camera.right();
  const auto length = [&](const Vec3f& at) { return (camera.pixel(at + across, size) - camera.pixel(at, size)).norm(); };
  const float at_target = length(camera.target());
  const Vec3f near = camera.target() + 0.4f * camera.backward(), far = camera.target() - 0.4f * camera.backward();
  CHECK(length(near) > 1.2f * length(far));
  camera.set_orthographic(true);
  for (const Vec3f& at : {near, far, camera.target()})
    CHECK(length(at) == doctest::Approx(at_target).epsilon(1e-4));
  // Its rays pass through what is seen there, from behind the eye on.
  for (const Vec3f& point : {Vec3f(near + across), Vec3f(far - across)}) {
    const Vec2f pixel = camera.pixel(point, size);
    const Ray ray = camera.ray(pixel.x(), pixel.y(), size);
    CHECK((point - ray.origin).cross(ray.direction).norm() < 1e-4f);
    CHECK((point - ray.origin).dot(ray.direction) > 0);
    CHECK((camera.drag(pixel.x(), pixel.y(), size, point) - point).norm() < 1e-4f);
  }
  // Depth grows away from the eye.
  const auto depth = [&](const Vec3f& at) -> float {
    const Eigen::Vector4f clip = camera.projection(size) * camera.view() * at.homogeneous();
    return clip.z() / clip.w();
  };
  CHECK(depth(near) < depth(camera.target()));
  CHECK(depth(camera.target()) < depth(far));
  CHECK((camera.eye() - camera.target()).normalized().dot(camera.backward()) > 0.9999f);
}

TEST_CASE("the camera turns about a point that stays where it is in the picture") {
  const Size size{640, 360};
  for (const bool orthographic : {false, true}) {
    CAPTURE(orthographic);
    Camera camera;
    camera.fit({0.1f, 0, 0}, 0.5f, size);
    camera.set_orthographic(orthographic);
    camera.pan(0.1f, -0.05f);
    const Vec3f pivot(0.3f, 0.2f, -0.15f);
    const Vec2f before = camera.pixel(pivot, size), target = camera.pixel(camera.target(), size);
    const Vec3f other = pivot + Vec3f(0, 0, 0.2f);
    const Vec2f other_before = camera.pixel(other, size);
    for (int k = 0; k < 5; ++k) {
      camera.orbit(0.3f, 0.1f, pivot);
      CHECK((camera.pixel(pivot, size) - before).norm() < 0.02f);
    }
    CHECK((camera.pixel(other, size) - other_before).norm() > 20);
    CHECK((camera.pixel(camera.target(), size) - target).norm() < 0.02f);
  }
}

TEST_CASE("standard views look along the axes, with y up where it can be") {
  CHECK((direction_of(StandardView::front) - Vec3f::UnitZ()).norm() < 1e-6f);
  CHECK((direction_of(StandardView::back) + Vec3f::UnitZ()).norm() < 1e-6f);
  CHECK((direction_of(StandardView::right) - Vec3f::UnitX()).norm() < 1e-6f);
  CHECK((direction_of(StandardView::left) + Vec3f::UnitX()).norm() < 1e-6f);
  CHECK((direction_of(StandardView::top) - Vec3f::UnitY()).norm() < 1e-6f);
  CHECK((direction_of(StandardView::bottom) + Vec3f::UnitY()).norm() < 1e-6f);
  for (std::size_t k = 0; k < standard_view_names.size(); ++k) {
    const auto view = static_cast<StandardView>(k);
    CHECK((direction_of(view) + direction_of(opposite(view))).norm() < 1e-6f);
  }
}

TEST_CASE("orbiting keeps the distance and stops at the poles") {
  Camera camera;
  camera.fit(Vec3f::Zero(), 1, {100, 100});
  const float distance = camera.eye().norm();
  camera.orbit(10, 10);
  CHECK(camera.eye().norm() == doctest::Approx(distance));
  CHECK(camera.up().y() > -1e-6f);
  CHECK(camera.eye().y() / distance == doctest::Approx(1));
  camera.orbit(0, -0.1f);
  CHECK(camera.eye().y() / distance == doctest::Approx(std::cos(0.1)));
}

}  // namespace heml::camera_test
