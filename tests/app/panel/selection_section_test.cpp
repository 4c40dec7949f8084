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
  driver.find("Held");
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

}  // namespace heml::selection_section_test
