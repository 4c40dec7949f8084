#include <imgui_internal.h>

#include <algorithm>
#include <app/panel/help.hpp>
#include <app/panel/keys.hpp>

#include "driver.hpp"

namespace heml::help_test {

using namespace heml::test;
using panel::Action;
using panel::HelpEntry;

namespace {

const std::vector<panel::Rows::Listed> rows{{"", {"Play", "Runs the simulation (Space)."}},
                                            {"Material", {"Young's E", "Stiffness in tension, kPa."}},
                                            {"Material", {"Density", ""}}};

void press(Driver& driver, Action key) {
  driver.panel.perform(key);
  for (int k = 0; k < 6; ++k) driver.draw();
}

}  // namespace

TEST_CASE("help finds keys and rows of the panel by any of their words") {
  CHECK(panel::find_help("stiffness", rows) ==
        std::vector<HelpEntry>{{"Material", "Young's E", "Stiffness in tension, kPa."}});
  CHECK(panel::find_help("material tension", rows).size() == 1);
  CHECK(panel::find_help("scalpel", {}) == std::vector<HelpEntry>{{"Keys", "C", "scalpel"}});
  CHECK(panel::find_help("mouse zoom", {}) == std::vector<HelpEntry>{{"Mouse", "Wheel", "zoom"}});
  CHECK(panel::find_help("play", rows).size() == 2);  // the key and the button
  CHECK(panel::find_help("no such word", rows).empty());
}

TEST_CASE("what is typed while the help is open is searched, and Esc closes it") {
  Driver driver;
  press(driver, Action::help);
  CHECK(driver.panel.is_modal());
  CHECK(ImGui::GetIO().WantTextInput);
  ImGui::GetIO().AddInputCharactersUTF8("young");
  for (int k = 0; k < 3; ++k) driver.draw();
  CHECK(driver.panel.is_modal());
  press(driver, Action::release);
  CHECK_FALSE(driver.panel.is_modal());
  CHECK_FALSE(driver.panel.covers(640, 360));
}

TEST_CASE("a click beside the help closes it, one on it does not") {
  Driver driver;
  press(driver, Action::help);
  driver.move({640, 360});
  driver.click();
  CHECK(driver.panel.is_modal());
  driver.move({1270, 750});
  driver.click();
  CHECK_FALSE(driver.panel.is_modal());
}

TEST_CASE("the help fits into windows of any width, its texts wrapped") {
  for (const float width : {240.0f, 300.0f, 500.0f, 1280.0f}) {
    CAPTURE(width);
    Driver driver(small_scene(), width, 480, 0.72f);
    press(driver, Action::help);
    const ImGuiWindow* window = ImGui::FindWindowByName("Mouse and keys");
    REQUIRE(window);
    CHECK(window->Size.x <= width);
    CHECK(window->ContentSize.x <= window->InnerRect.GetWidth() - 2 * window->WindowPadding.x + 1);
    CHECK(window->ContentSize.x > 0.6f * std::min(width, 700.0f));
  }
}

TEST_CASE("rows list themselves only while they are searched") {
  const ImguiContext context(640, 480, 1);
  panel::Rows drawn;
  for (const bool lists : {false, true, false}) {
    ImGui::NewFrame();
    drawn.new_frame(lists);
    ImGui::Begin("rows");
    double value = 20;
    if (drawn.section("Material")) drawn.slider({"Young's E", "Stiffness."}, value, {1, 100});  // a name and a control
    ImGui::End();
    ImGui::Render();
    CHECK(drawn.listed().size() == (lists ? 1 : 0));
    if (lists) CHECK(drawn.listed()[0].section == "Material");
  }
}

}  // namespace heml::help_test
