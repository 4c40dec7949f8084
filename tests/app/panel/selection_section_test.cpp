#include "driver.hpp"

namespace heml::selection_section_test {

using namespace heml::test;
using Drag = panel::SelectionSection::Drag;

namespace {

struct Selecting : Driver {
  Selecting() : Driver(small_scene(), 1280, 1000) {
    frame.conditions = std::make_shared<const Conditions>(
        Conditions{{{{10, 11}}}, {{Load::Kind::force, {12}, Vec3(1, 0, 0)}}, 14});
    panel.perform(panel::Action::select_nodes);
    draw();
  }
  void select(const std::vector<int>& nodes) {
    panel.selecting().selection().take(nodes, panel::NodeSelection::How::replace);
    for (int k = 0; k < 2; ++k) draw();
  }
};

}  // namespace

TEST_CASE("the section is there while the tool is chosen or something is selected") {
  Selecting driver;
  CHECK(driver.panel.tool().tool == panel::Tool::select);
  driver.find("Selected");
  driver.select({11, 12});
  driver.panel.perform(panel::Action::select_grasper);
  driver.draw();
  driver.find("Constrained");
}

TEST_CASE("what a drag does is chosen") {
  Selecting driver;
  CHECK(driver.panel.selecting().drag() == Drag::rectangle);
  driver.choose("Drag", "lasso");
  CHECK(driver.panel.selecting().drag() == Drag::lasso);
  CHECK_FALSE(driver.panel.selecting().through());
  driver.click("Through the body", 30);
  CHECK(driver.panel.selecting().through());
}

TEST_CASE("selected nodes are fixed, freed, loaded and unloaded by buttons") {
  Selecting driver;
  driver.select({11, 12});
  const auto fix = driver.click("Fix", 60).commands;
  REQUIRE(fix.size() == 1);
  CHECK(std::get<SetBoundary>(fix[0]).entries == std::vector{Boundary{{10, 11, 12}}});
  const auto free = driver.click("Free", 220).commands;
  REQUIRE(free.size() == 1);
  CHECK(std::get<SetBoundary>(free[0]).entries == std::vector{Boundary{{10}}});
  const auto load = driver.click("Load", 60).commands;
  REQUIRE(load.size() == 1);
  CHECK(std::get<SetLoads>(load[0]).entries.at(1).nodes == std::vector{11, 12});
  const auto unload = driver.click("Unload", 220).commands;
  REQUIRE(unload.size() == 1);
  CHECK(std::get<SetLoads>(unload[0]).entries.empty());
  driver.select({13});
  CHECK(driver.click("Free", 220).commands.empty());  // nothing holds it
}

TEST_CASE("selected nodes are pinned and unpinned by buttons and keys") {
  Selecting driver;
  PinState pin;
  pin.nodes = {12};
  driver.frame.tools = {pin};
  driver.select({11, 12});
  const auto pinned = driver.click("Pin", 60).commands, unpinned = driver.click("Unpin", 220).commands;
  REQUIRE(pinned.size() == 1);
  CHECK(std::get<PinTissue>(pinned[0]).nodes == std::vector{11, 12});
  REQUIRE(unpinned.size() == 1);
  CHECK(std::get<Unpin>(unpinned[0]).nodes == std::vector{11, 12});
  driver.panel.perform(panel::Action::pin_selected);
  driver.panel.perform(panel::Action::unpin_selected);
  CHECK(driver.draw().commands.size() == 2);
  driver.select({});
  driver.panel.perform(panel::Action::pin_selected);
  CHECK(driver.draw().commands.empty());
}

TEST_CASE("selected nodes and those inside are tagged as a region, whose material is shown") {
  Selecting driver;
  driver.select({11, 12});
  driver.panel.selecting().inside().take({3}, panel::NodeSelection::How::add);
  driver.draw();
  const auto commands = driver.click("Tag as region", 60).commands;
  REQUIRE(commands.size() == 1);
  const TagRegion& tag = std::get<TagRegion>(commands[0]);
  CHECK(tag.tag.nodes == std::vector{3, 11, 12});
  CHECK(tag.tag.name == "part 1");
  CHECK_FALSE(tag.material);
  driver.click("Its material", 220);
  CHECK_FALSE(driver.panel.selecting().take_region());  // there is none of this name
  Scene scene;
  driver.panel.write_into(scene);
  RegionMaterial part = scene.materials.at(0), other = part;
  part.region = 4;
  other.region = 5;
  driver.frame.regions = std::make_shared<const Regions>(
      Regions{1, {4, 5}, {{4, "part 1"}, {5, "rest"}}, {}, {scene.materials[0], part, other}});
  driver.draw();
  driver.click("Its material", 220);
  driver.choose("Law", "Ogden");
  driver.panel.write_into(scene);
  CHECK(scene.materials.at(1).material.law == "ogden");
}

}  // namespace heml::selection_section_test
