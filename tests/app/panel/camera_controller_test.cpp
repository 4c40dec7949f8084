#include <app/panel/camera_controller.hpp>

#include "driver.hpp"

namespace heml::camera_controller_test {

using namespace heml::test;

namespace {
const render::Size size{640, 360};
const SurfaceMesh surface_mesh = small_surface();
const Vec3f centre(0.05f, 0.05f, 0.05f);  // of the body's bounding box
}  // namespace

TEST_CASE("the body is in the middle of what the panel leaves free") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {200, 0});
  const render::Vec2f at = controller.camera().pixel(centre, size);
  CHECK(at.x() == doctest::Approx(200 + 440 / 2.0).epsilon(0.005));
  CHECK(at.y() == doctest::Approx(180).epsilon(0.005));
  controller.resize(size, {});
  CHECK(controller.camera().pixel(centre, size).x() == doctest::Approx(320).epsilon(0.005));
}

TEST_CASE("the body stays in the middle while it is turned, and fits between the columns") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {200, 150});
  for (int k = 0; k < 10; ++k) {
    controller.orbit(37, -11);
    CHECK(controller.camera().pixel(centre, size).x() == doctest::Approx(200 + 290 / 2.0).epsilon(0.005));
    for (const Vec3f& node : surface_mesh.rest) {
      const render::Vec2f at = controller.camera().pixel(node, size);
      CHECK(at.x() > 195);
      CHECK(at.x() < 495);
    }
  }
}

TEST_CASE("the body turns about a point that stays where it is, beside the panel and in panes") {
  for (const std::size_t bodies : {1, 4}) {
    panel::CameraController controller;
    controller.fit({}, surface_mesh, size, {200, 0}, bodies);
    controller.select_pane(bodies - 1);
    const Vec3f& pivot = surface_mesh.rest[1];
    const render::Vec2f before = controller.pixel(pivot), far = controller.pixel(surface_mesh.rest[2]);
    controller.orbit(40, 15, pivot);
    CHECK((controller.pixel(pivot) - before).norm() < 0.05f);
    CHECK((controller.pixel(surface_mesh.rest[2]) - far).norm() > 5);
  }
}

TEST_CASE("a standard view keeps what is in the middle there") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {200, 0});
  const render::Vec2f before = controller.pixel(centre);
  controller.look(StandardView::top);
  CHECK((controller.pixel(centre) - before).norm() < 0.05f);
  // x to the right, z down.
  const render::Vec2f x = controller.pixel(centre + Vec3f(0.01f, 0, 0));
  const render::Vec2f z = controller.pixel(centre + Vec3f(0, 0, 0.01f));
  CHECK(x.x() > before.x() + 1);
  CHECK(x.y() == doctest::Approx(before.y()).epsilon(0.01));
  CHECK(z.y() > before.y() + 1);
}

TEST_CASE("panning moves the body with the mouse") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {});
  const render::Vec2f before = controller.camera().pixel(centre, size);
  controller.pan(30, 20);
  const render::Vec2f after = controller.camera().pixel(centre, size);
  CHECK(after.x() - before.x() == doctest::Approx(30).epsilon(0.02));
  CHECK(after.y() - before.y() == doctest::Approx(20).epsilon(0.02));
}

TEST_CASE("the wheel brings the body nearer") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {});
  const auto extent = [&] {
    return (controller.camera().pixel(surface_mesh.rest[1], size) -
            controller.camera().pixel(surface_mesh.rest[2], size))
        .norm();
  };
  const float before = extent();
  controller.zoom(2);
  CHECK(extent() > 1.15f * before);
}

TEST_CASE("a saved view is restored after the camera moved") {
  panel::CameraController controller;
  controller.fit({}, surface_mesh, size, {});
  controller.orbit(80, 20);
  const render::Vec2f before = controller.camera().pixel({0.1f, 0, 0}, size);
  controller.save_view(2);
  controller.orbit(-200, 50);
  controller.zoom(4);
  CHECK_FALSE(controller.restore_view(1));
  CHECK((controller.camera().pixel({0.1f, 0, 0}, size) - before).norm() > 10);
  CHECK(controller.restore_view(2));
  CHECK((controller.camera().pixel({0.1f, 0, 0}, size) - before).norm() < 1e-3);
  panel::CameraController another;
  another.fit({}, surface_mesh, size, {});
  another.set_saved_views(controller.saved_views());
  CHECK(another.restore_view(2));
  CHECK((another.camera().pixel({0.1f, 0, 0}, size) - before).norm() < 1e-3);
  controller.set_saved_views({});
  CHECK_FALSE(controller.has_view(2));
}

TEST_CASE("several bodies share the free area with equal size, each centred in its pane") {
  for (const std::size_t bodies : {2, 3, 4}) {
    CAPTURE(bodies);
    panel::CameraController controller;
    controller.fit({}, surface_mesh, size, {200, 100}, bodies);
    REQUIRE(controller.panes().size() == bodies);
    const std::size_t columns = bodies == 4 ? 2 : bodies;
    const float part = 340 / static_cast<float>(columns);
    int area = 0;
    float extent = 0;
    for (std::size_t pane = 0; pane < bodies; ++pane) {
      controller.select_pane(pane);
      const render::Vec2f at = controller.pixel(centre);
      CHECK(at.x() == doctest::Approx(200 + part * (static_cast<float>(pane % columns) + 0.5f)).epsilon(0.01));
      CHECK(at.y() == doctest::Approx(bodies == 4 ? 90 + 180 * static_cast<float>(pane / 2) : 180).epsilon(0.01));
      const float here = (controller.pixel(surface_mesh.rest[1]) - controller.pixel(surface_mesh.rest[2])).norm();
      if (pane > 0) CHECK(here == doctest::Approx(extent).epsilon(0.02));
      extent = here;
      area += controller.pane().size.width * controller.pane().size.height;
      // The ray of a pixel hits the point drawn there; entering at the pixel selects its pane.
      const render::Ray ray = controller.ray(at);
      CHECK((centre - ray.origin).cross(ray.direction).norm() < 1e-4f);
      CHECK((controller.drag(at, centre) - centre).norm() < 1e-4f);
      controller.select_pane(0);
      controller.select_pane_at(at);
      CHECK(controller.current() == pane);
    }
    CHECK(area == size.width * size.height);
  }
}

TEST_CASE("a body that has moved is fitted where it is") {
  std::vector<Vec3f> moved = surface_mesh.rest;
  for (Vec3f& place : moved) place += Vec3f(0.5f, -2, 0);
  panel::CameraController at_rest, controller;
  at_rest.fit({}, surface_mesh, {800, 600}, {});
  controller.fit({}, render::bounding_sphere(moved), {800, 600}, {});
  for (std::size_t k = 0; k < moved.size(); ++k)
    CHECK((controller.pixel(moved[k]) - at_rest.pixel(surface_mesh.rest[k])).norm() < 0.1f);
}

}  // namespace heml::camera_controller_test
