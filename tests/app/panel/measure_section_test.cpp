#include <app/panel/measure_section.hpp>

#include "driver.hpp"

namespace heml::measure_section_test {

using namespace heml::test;

namespace {
/// A point at a node of small_surface().
render::SurfacePoint at_node(int node) { return {{node, node, node}, {1, 0, 0}}; }
}  // namespace

TEST_CASE("the text beside the line has what is known") {
  panel::Measured measured;
  measured.places.resize(1);
  CHECK(panel::measured_text(measured).empty());
  measured.places.resize(2);
  measured.distance = 0.0123;
  CHECK(panel::measured_text(measured) == "12.3 mm");
  measured.places.resize(3);
  measured.second = 0.1;
  measured.angle = 45.62;
  CHECK(panel::measured_text(measured) == "12.3 mm and 100 mm, 45.6°");
}

TEST_CASE("the section shows with the tool or with points, asks to be saved, and forgets") {
  Driver driver(small_scene(), 1280, 1000);
  driver.frame.surface_mesh = std::make_shared<const SurfaceMesh>(small_surface());
  driver.panel.perform(panel::Action::select_measure);
  driver.draw();
  CHECK(driver.panel.tool().tool == panel::Tool::measure);
  driver.find("Measure");
  driver.panel.measure().add(at_node(10));
  driver.panel.measure().add(at_node(11));
  driver.panel.perform(panel::Action::select_grasper);
  driver.draw();
  driver.find("Distance 1 to 2");
  CHECK(driver.click("Save CSV", 100).requests == std::vector{panel::Request::save_measured});
  driver.click("Clear", 220);
  CHECK(driver.panel.measure().is_empty());
}

}  // namespace heml::measure_section_test
