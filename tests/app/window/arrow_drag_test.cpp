#include <doctest/doctest.h>

#include <app/window/arrow_drag.hpp>

namespace heml::arrow_drag_test {

using namespace heml::window;

namespace {

/// A camera that looks along −z at a body of 0.1 m, without perspective.
struct Front {
  panel::CameraController controller;
  ArrowDrag drag;

  Front() {
    SurfaceMesh surface_mesh;
    surface_mesh.rest = {{-0.05f, -0.05f, 0}, {0.05f, 0.05f, 0}};
    View view;
    view.azimuth = view.elevation = 0;
    view.orthographic = true;
    controller.fit(view, surface_mesh, {640, 360}, {});
  }
  render::Vec2f pixel(float x, float y) const { return controller.pixel({x, y, 0}); }
};

bool near(const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-4 * b.norm(); }

const Arrow arrow{{0.01f, 0, 0}, Vec3(0, 0.5, 0), 0.02f, 1};

}  // namespace

TEST_CASE("an arrow has its length whatever its value, and its tip is met near its pixel") {
  const Front front;
  CHECK((arrow.tip() - Vec3f(0.01f, 0.02f, 0)).norm() < 1e-7f);
  Arrow none = arrow;
  none.value.setZero();
  CHECK(none.tip() == none.from);
  const render::Vec2f tip = front.pixel(0.01f, 0.02f);
  CHECK(ArrowDrag::is_on_tip(arrow, tip + render::Vec2f(3, -3), 8, front.controller));
  CHECK_FALSE(ArrowDrag::is_on_tip(arrow, tip + render::Vec2f(8, 8), 8, front.controller));
}

TEST_CASE("a dragged tip sets direction and size, in the scale that it was pressed with") {
  Front front;
  front.drag.press(arrow);
  CHECK(front.drag.value() == arrow.value);
  front.drag.move(front.pixel(0.05f, 0.03f), false, front.controller);
  CHECK(near(front.drag.value(), Vec3(1, 0.75, 0)));  // 25 N/m
  CHECK((front.drag.tip() - Vec3f(0.05f, 0.03f, 0)).norm() < 1e-5f);
  front.drag.move(front.pixel(0.0101234f, -0.04f), false, front.controller);
  CHECK(front.drag.value().x() == doctest::Approx(0.003).epsilon(1e-9));  // to four digits of its size
  front.drag.move(front.pixel(0.01f, -0.04f), false, front.controller);
  const auto value = front.drag.release();
  REQUIRE(value);
  CHECK(near(*value, Vec3(0, -1, 0)));
  CHECK_FALSE(front.drag.is_on());
}

TEST_CASE("what a value has along the line of sight stays") {
  Front front;
  Arrow deep = arrow;
  deep.value = Vec3(0, 3, 4);
  front.drag.press(deep);
  front.drag.move(front.pixel(0.01f + 0.012f, 0), false, front.controller);
  CHECK(near(front.drag.value(), Vec3(3, 0, 4)));
}

TEST_CASE("along an axis it is that of its largest component") {
  Front front;
  front.drag.press(arrow);
  front.drag.move(front.pixel(0.01f - 0.04f, 0.03f), true, front.controller);
  CHECK(near(front.drag.value(), Vec3(-1, 0, 0)));
}

TEST_CASE("an arrow of nothing is drawn out from its start, in its usual scale") {
  Front front;
  Arrow none = arrow;
  none.value.setZero();
  front.drag.press(none);
  front.drag.move(front.pixel(0.01f, 0.04f), false, front.controller);
  CHECK(near(front.drag.value(), Vec3(0, 2, 0)));
}

TEST_CASE("a press without a move, and a drag that is cancelled, set nothing") {
  Front front;
  front.drag.press(arrow);
  CHECK_FALSE(front.drag.release());
  front.drag.press(arrow);
  front.drag.move(front.pixel(0.05f, 0.03f), false, front.controller);
  front.drag.cancel();
  CHECK_FALSE(front.drag.is_on());
  front.drag.press(arrow);
  CHECK_FALSE(front.drag.release());
}

}  // namespace heml::arrow_drag_test
