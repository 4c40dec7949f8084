#include <app/panel/stretch_monitor.hpp>
#include <heml/scenario/presets.hpp>

#include "driver.hpp"

namespace heml::stretch_watch_test {

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

TEST_CASE("nothing is watched, and nothing hatched, while no tissue has a range") {
  panel::StretchMonitor watch(small_surface());
  const RegionMaterial entry{std::nullopt, free_material()};
  watch.set(std::span(&entry, 1));
  CHECK_FALSE(watch.active());
  watch.update(frame_with({1, 9, 9, 9}));
  CHECK(watch.beyond().empty());
  CHECK(watch.share() == 0);
}

TEST_CASE("nodes stretched past the tissue's range are counted and marked") {
  panel::StretchMonitor watch(small_surface());
  const RegionMaterial entry{std::nullopt, limited().material};
  watch.set(std::span(&entry, 1));
  REQUIRE(watch.active());
  CHECK(watch.beyond().empty());  // no frame yet
  watch.update(frame_with({1.0f, 1.2f, 1.3f, 1.5f}));
  REQUIRE(watch.beyond().size() == 4);
  CHECK(watch.beyond()[0] < 0);
  CHECK(watch.beyond()[1] < 0);
  CHECK(watch.beyond()[2] == doctest::Approx(1.3 - limited().stretch_range->high));
  CHECK(watch.beyond()[3] > watch.beyond()[2]);
  CHECK(watch.share() == 0.5);
  watch.update(frame_with({}));  // a frame without stretches
  CHECK(watch.beyond().empty());
  CHECK(watch.share() == 0);
}

TEST_CASE("each region has the limit of its own material") {
  SurfaceMesh surface_mesh = small_surface();
  surface_mesh.regions = {7, 7, 7, 2};  // the last triangle has nodes 1, 2 and 3
  panel::StretchMonitor watch(surface_mesh);
  const RegionMaterial entries[] = {{std::nullopt, free_material()}, {2, limited().material}};
  watch.set(entries);
  REQUIRE(watch.active());
  watch.update(frame_with({3, 3, 1, 1}));
  CHECK(watch.beyond()[0] < 0);  // of region 7 alone
  CHECK(watch.beyond()[1] > 0);
  CHECK(watch.share() == doctest::Approx(1.0 / 3));
}

TEST_CASE("the panel asks for stretches once a tissue with a range is chosen, and hands out what to hatch") {
  Driver driver;
  CHECK_FALSE(driver.panel.wants_stretches());
  CHECK(driver.panel.drawing().beyond.empty());
  driver.choose("Tissue", limited().title);
  CHECK(driver.panel.wants_stretches());
  driver.frame.stretches = {1, 1, 1, 2};
  driver.draw();
  REQUIRE(driver.panel.drawing().beyond.size() == 4);
  CHECK(driver.panel.drawing().beyond[3] > 0);
}

}  // namespace heml::stretch_watch_test
