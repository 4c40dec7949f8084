#include "app/panel/section_control.hpp"

#include "driver.hpp"

namespace heml::section_control_test {

using namespace heml::panel;
using heml::test::small_surface;

namespace {
constexpr float radius = 0.0866f;  // m, of small_surface() about (0.05, 0.05, 0.05)
}

TEST_CASE("the plane of a scene's view is taken over, and written back") {
  View view;
  CHECK_FALSE(SectionControl(view, small_surface()).plane());
  view.section = Vec3(0, -1, 0);
  view.section_at = 0.02;
  const SectionControl control(view, small_surface());
  REQUIRE(control.plane());
  CHECK(control.plane()->normal == Vec3f(0, -1, 0));
  CHECK(control.plane()->offset == doctest::Approx(-0.03));  // y = 0.05 − 0.02
  view.section = Vec3(1, 2, 2) / 3;
  const SectionControl slanted(view, small_surface());
  CHECK((slanted.plane()->normal - Vec3f(1, 2, 2) / 3).norm() < 1e-6f);
  View written;
  slanted.write_into(written);
  REQUIRE(written.section);
  CHECK((*written.section - *view.section).norm() < 1e-6);
  CHECK(written.section_at == 0.02);
}

TEST_CASE("switching off and on again keeps the plane") {
  View view;
  view.section = Vec3(0, 0, 1);
  view.section_at = -0.01;
  SectionControl control(view, small_surface());
  control.toggle();
  CHECK_FALSE(control.plane());
  View written = view;
  control.write_into(written);
  CHECK_FALSE(written.section);
  control.toggle();
  REQUIRE(control.plane());
  CHECK(control.plane()->normal == Vec3f(0, 0, 1));
  CHECK(control.plane()->offset == doctest::Approx(0.04));
}

TEST_CASE("the handle follows the mouse along the normal and stays in the body's reach") {
  View view;
  view.section = Vec3(1, 0, 0);
  view.azimuth = view.elevation = 0;
  SectionControl control(view, small_surface());
  CameraController controller;
  controller.fit(view, small_surface(), {800, 600}, {});
  const render::Vec2f from = controller.pixel(control.handle());
  control.drag(from, from + render::Vec2f(40, 25), controller);
  const render::Vec2f to = controller.pixel(control.handle());
  CHECK(to.x() - from.x() == doctest::Approx(40).epsilon(0.02));
  CHECK(std::abs(to.y() - from.y()) < 0.1f);
  control.drag(to, to + render::Vec2f(5000, 0), controller);
  CHECK((control.handle() - Vec3f(0.05f, 0.05f, 0.05f)).norm() == doctest::Approx(radius).epsilon(0.01));
}

TEST_CASE("a normal towards the eye is dragged up and down") {
  View view;
  view.section = Vec3(0, 0, 1);
  view.azimuth = view.elevation = 0;
  SectionControl control(view, small_surface());
  CameraController controller;
  controller.fit(view, small_surface(), {800, 600}, {});
  const Vec3f before = control.handle();
  control.drag({400, 300}, {400, 270}, controller);
  CHECK(control.handle().z() > before.z() + 0.001f);
}

}  // namespace heml::section_control_test
