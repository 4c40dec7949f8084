#include <app/panel/eye.hpp>

#include "driver.hpp"

namespace heml::eye_test {

using namespace heml::test;

namespace {
const render::Size size{640, 360};
const Skin skin = small_skin();
const Vec3f centre(0.05f, 0.05f, 0.05f);  // of the body's box
}  // namespace

TEST_CASE("the body is in the middle of what the panel leaves free") {
  panel::Eye eye;
  eye.fit({}, skin, size, {200, 0});
  const render::Vec2f at = eye.camera().pixel(centre, size);
  CHECK(at.x() == doctest::Approx(200 + 440 / 2.0).epsilon(0.005));
  CHECK(at.y() == doctest::Approx(180).epsilon(0.005));
  eye.resize(size, {});
  CHECK(eye.camera().pixel(centre, size).x() == doctest::Approx(320).epsilon(0.005));
}

TEST_CASE("the body stays in the middle while it is turned, and fits between the columns") {
  panel::Eye eye;
  eye.fit({}, skin, size, {200, 150});
  for (int k = 0; k < 10; ++k) {
    eye.orbit(37, -11);
    CHECK(eye.camera().pixel(centre, size).x() == doctest::Approx(200 + 290 / 2.0).epsilon(0.005));
    for (const Vec3f& node : skin.rest) {
      const render::Vec2f at = eye.camera().pixel(node, size);
      CHECK(at.x() > 195);
      CHECK(at.x() < 495);
    }
  }
}

TEST_CASE("panning moves the body with the mouse") {
  panel::Eye eye;
  eye.fit({}, skin, size, {});
  const render::Vec2f before = eye.camera().pixel(centre, size);
  eye.pan(30, 20);
  const render::Vec2f after = eye.camera().pixel(centre, size);
  CHECK(after.x() - before.x() == doctest::Approx(30).epsilon(0.02));
  CHECK(after.y() - before.y() == doctest::Approx(20).epsilon(0.02));
}

TEST_CASE("the wheel brings the body nearer") {
  panel::Eye eye;
  eye.fit({}, skin, size, {});
  const auto extent = [&] {
    return (eye.camera().pixel(skin.rest[1], size) - eye.camera().pixel(skin.rest[2], size)).norm();
  };
  const float before = extent();
  eye.zoom(2);
  CHECK(extent() > 1.15f * before);
}

TEST_CASE("a view that was kept is gone back to, whatever the picture has become") {
  panel::Eye eye;
  eye.fit({}, skin, size, {});
  eye.orbit(80, 20);
  const render::Vec2f before = eye.camera().pixel({0.1f, 0, 0}, size);
  eye.keep(2);
  eye.orbit(-200, 50);
  eye.zoom(4);
  CHECK_FALSE(eye.go_to(1));
  CHECK((eye.camera().pixel({0.1f, 0, 0}, size) - before).norm() > 10);
  CHECK(eye.go_to(2));
  CHECK((eye.camera().pixel({0.1f, 0, 0}, size) - before).norm() < 1e-3);
  eye.forget();
  CHECK_FALSE(eye.has(2));
}

TEST_CASE("several bodies share what the panel leaves free, each in the middle of its part, all as large") {
  for (const std::size_t bodies : {2, 3, 4}) {
    CAPTURE(bodies);
    panel::Eye eye;
    eye.fit({}, skin, size, {200, 100}, bodies);
    REQUIRE(eye.panes().size() == bodies);
    const std::size_t columns = bodies == 4 ? 2 : bodies;
    const float part = 340 / static_cast<float>(columns);
    int area = 0;
    float extent = 0;
    for (std::size_t pane = 0; pane < bodies; ++pane) {
      eye.enter_pane(pane);
      const render::Vec2f at = eye.pixel(centre);
      CHECK(at.x() == doctest::Approx(200 + part * (static_cast<float>(pane % columns) + 0.5f)).epsilon(0.01));
      CHECK(at.y() == doctest::Approx(bodies == 4 ? 90 + 180 * static_cast<float>(pane / 2) : 180).epsilon(0.01));
      const float here = (eye.pixel(skin.rest[1]) - eye.pixel(skin.rest[2])).norm();
      if (pane > 0) CHECK(here == doctest::Approx(extent).epsilon(0.02));
      extent = here;
      area += eye.pane().size.width * eye.pane().size.height;
      // The ray of a pixel meets what appears there, and the mouse means the pane it is in.
      const render::Ray ray = eye.ray(at);
      CHECK((centre - ray.origin).cross(ray.direction).norm() < 1e-4f);
      CHECK((eye.drag(at, centre) - centre).norm() < 1e-4f);
      eye.enter_pane(0);
      eye.enter(at);
      CHECK(eye.current() == pane);
    }
    CHECK(area == size.width * size.height);
  }
}

}  // namespace heml::eye_test
