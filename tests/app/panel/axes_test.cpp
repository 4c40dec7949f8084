#include <imgui_internal.h>

#include <app/panel/axes.hpp>

#include "driver.hpp"

namespace heml::axes_test {

using namespace heml::test;

namespace {
render::Camera camera_at(float azimuth, float elevation) {
  render::Camera camera;
  camera.fit(Vec3f::Zero(), 1, {1280, 760});
  camera.look(azimuth, elevation);
  return camera;
}
}  // namespace

TEST_CASE("a click on an end looks from there, and from the opposite side where the camera is there already") {
  const render::Camera front = camera_at(0, 0);
  CHECK(panel::view_after_click(StandardView::front, front) == StandardView::back);
  CHECK(panel::view_after_click(StandardView::right, front) == StandardView::right);
  CHECK(panel::view_after_click(StandardView::front, camera_at(0.1f, 0)) == StandardView::front);
}

TEST_CASE("the ends of the axes are found where they are drawn, and cover the image") {
  Driver driver;
  const auto axes = [&] {  // of the two columns' window, in the corner left of the readings
    return 1280 - panel::em(16.7f + 0.5f + 2.8f);
  };
  CHECK_FALSE(driver.panel.covers(axes(), 50));
  driver.panel.set_camera(camera_at(0, 0));
  driver.draw();
  CHECK(driver.panel.covers(axes(), 50));
  const ImVec2 top = driver.find("Axis +y", axes()), bottom = driver.find("Axis −y", axes());
  CHECK(top.y < bottom.y);
  driver.move(top);
  CHECK(driver.click().look == StandardView::top);
  driver.find("Axis +z", axes());
  CHECK(driver.click().look == StandardView::back);
  const float right = axes() + panel::em(2.1f);
  driver.find("Axis +x", right);
  CHECK(driver.click().look == StandardView::right);
  driver.panel.set_camera(camera_at(3.14159265f, 0));
  driver.find("Axis −x", right);
  CHECK(driver.click().look == StandardView::left);
}

TEST_CASE("the axes stand below the labels of comparison runs") {
  for (const bool compares : {false, true}) {
    Driver driver(small_scene(), 480, 360, 0.72f);
    if (compares) driver.frame.comparisons.emplace_back();
    driver.panel.set_camera(camera_at(0, 0));
    driver.draw();
    const ImGuiWindow* axes = ImGui::FindWindowByName("axes");
    REQUIRE(axes);
    CHECK((axes->Pos.y > panel::em(3.4f)) == compares);
  }
}

TEST_CASE("the section View has the standard views, with Ctrl the opposite ones, and the orthographic camera") {
  Scene scene = small_scene();
  Driver driver(scene, 1280, 1000);
  render::Camera camera = camera_at(0.3f, 0.2f);
  driver.panel.set_camera(camera);
  CHECK(driver.click("Right", 95).look == StandardView::right);
  driver.find("Right", 95);
  ImGui::GetIO().KeyCtrl = true;
  CHECK(driver.click().look == StandardView::left);
  ImGui::GetIO().KeyCtrl = false;
  CHECK(driver.click("Orthographic", 170).orthographic == true);
  camera.set_orthographic(true);
  driver.panel.set_camera(camera);
  driver.panel.write_into(scene);
  CHECK(scene.view.orthographic);
  driver.find("Orthographic", 170);
  CHECK(driver.click().orthographic == false);
}

}  // namespace heml::axes_test
