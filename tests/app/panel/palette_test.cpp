#include <app/panel/keys.hpp>
#include <app/panel/palette.hpp>

#include "driver.hpp"

namespace heml::palette_test {

using namespace heml::test;
using panel::Request;
using panel::Tool;

namespace {
constexpr float edge = 318;  // pixels, the middle of the palette at scale 1
}

TEST_CASE("every tool is in the palette, and a click or its key selects it") {
  Driver driver(small_scene(), 1280, 720);
  CHECK(panel::tool_table().size() == static_cast<std::size_t>(Tool::select) + 1);
  for (const panel::ToolInfo& info : panel::tool_table()) {
    driver.click(info.title, edge);
    CHECK(driver.panel.tool().tool == info.tool);
  }
  for (const panel::ToolInfo& info : panel::tool_table()) {
    const std::string key = panel::key_name(info.select);
    REQUIRE(key.size() == 1);
    driver.panel.perform(*panel::action_of(key[0], false));
    driver.draw();
    CHECK(driver.panel.tool().tool == info.tool);
  }
}

TEST_CASE("what is done to picture and scene is in the palette at 1280x720 and at 640x360") {
  for (const auto& [width, height, scale, x] :
       {std::tuple(1280.0f, 720.0f, 1.0f, edge), std::tuple(640.0f, 360.0f, 0.72f, 230.0f)}) {
    Driver driver(small_scene(), width, height, scale);
    CHECK(driver.click("Fit view", x).requests == std::vector{Request::fit});
    CHECK(driver.click("Save image", x).requests == std::vector{Request::screenshot});
    CHECK(driver.click("Film", x).requests == std::vector{Request::record_video});
    driver.panel.set_filmed_frames(12);
    driver.draw();
    CHECK(driver.click("Stop filming", x).requests == std::vector{Request::record_video});
    CHECK(driver.click("Save scene", x).requests == std::vector{Request::save});
    const auto table = driver.click("Table", x);
    REQUIRE(table.commands.size() == 1);
    CHECK(std::get<SetTables>(table.commands.front()).tables.size() == 1);
  }
}

TEST_CASE("the palette takes the mouse where it is, and is hidden with the panel") {
  Driver driver;
  CHECK(driver.panel.covers(edge, 60));
  CHECK_FALSE(driver.panel.covers(edge + 60, 60));
  driver.panel.perform(panel::Action::hide);
  for (int k = 0; k < 2; ++k) driver.draw();
  CHECK_FALSE(driver.panel.covers(edge, 60));
}

}  // namespace heml::palette_test
