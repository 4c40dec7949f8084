#include <app/panel/stretch_monitor.hpp>
#include <heml/scenario/presets.hpp>

#include "driver.hpp"

namespace heml::stretch_monitor_test {

using namespace heml::test;

namespace {

const Preset& limited() { return *find_preset("brain_ogden_swine"); }  // measured to a stretch of 1.2214

Material free_material() {
  Material material;
  material.law = "stvk";
  material.parameters = {1e4, 1e4};
  return material;
}

Frame frame_with(std::vector<float> stretches) {
  Frame frame;
  frame.positions = small_surface().rest;
  frame.stretches = std::move(stretches);
  return frame;
}

}  // namespace

TEST_CASE("the stretch monitor is inactive while no tissue has a measured range") {
  panel::StretchMonitor monitor(small_surface());
  const RegionMaterial entry{std::nullopt, free_material()};
  monitor.set(std::span(&entry, 1));
  CHECK_FALSE(monitor.active());
  monitor.update(frame_with({1, 9, 9, 9}));
  CHECK(monitor.beyond().empty());
  CHECK(monitor.share() == 0);
}

TEST_CASE("nodes stretched beyond the measured range are counted and marked") {
  panel::StretchMonitor monitor(small_surface());
  const RegionMaterial entry{std::nullopt, limited().material};
  monitor.set(std::span(&entry, 1));
  REQUIRE(monitor.active());
  CHECK(monitor.beyond().empty());  // no frame yet
  monitor.update(frame_with({1.0f, 1.2f, 1.3f, 1.5f}));
  REQUIRE(monitor.beyond().size() == 4);
  CHECK(monitor.beyond()[0] < 0);
  CHECK(monitor.beyond()[1] < 0);
  CHECK(monitor.beyond()[2] == doctest::Approx(1.3 - limited().stretch_range->high));
  CHECK(monitor.beyond()[3] > monitor.beyond()[2]);
  CHECK(monitor.share() == 0.5);
  monitor.update(frame_with({}));  // a frame without stretches
  CHECK(monitor.beyond().empty());
  CHECK(monitor.share() == 0);
}

TEST_CASE("each region has the limit of its own material") {
  SurfaceMesh surface_mesh = small_surface();
  surface_mesh.regions = {7, 7, 7, 2};  // the last triangle has nodes 1, 2 and 3
  panel::StretchMonitor monitor(surface_mesh);
  const RegionMaterial entries[] = {{std::nullopt, free_material()}, {2, limited().material}};
  monitor.set(entries);
  REQUIRE(monitor.active());
  monitor.update(frame_with({3, 3, 1, 1}));
  CHECK(monitor.beyond()[0] < 0);  // of region 7 alone
  CHECK(monitor.beyond()[1] > 0);
  CHECK(monitor.share() == doctest::Approx(1.0 / 3));
}

TEST_CASE("the panel requests stretches and hatches nodes once a tissue with a measured range is selected") {
  Driver driver;
  CHECK_FALSE(driver.panel.wants_stretches());
  CHECK(driver.panel.drawing().hatched.empty());
  driver.choose("Tissue", limited().title);
  CHECK(driver.panel.wants_stretches());
  driver.frame.stretches = {1, 1, 1, 2};
  driver.draw();
  REQUIRE(driver.panel.drawing().hatched.size() == 4);
  CHECK(driver.panel.drawing().hatched[3] > 0);
}

}  // namespace heml::stretch_monitor_test
