#include "driver.hpp"

namespace heml::open_dialog_test {

using namespace heml::test;
using panel::Action;
using panel::OpenChoice;
using panel::OpenChoices;
using panel::Request;

namespace {

OpenChoices some_choices() {
  OpenChoices choices;
  choices.scenes = {{"/assets/kidney.json", "Kidney, held by its vessels", "Grasp it anywhere and pull."},
                    {"/assets/beam.json", "Cantilever", "A soft beam bends under its own weight."},
                    {"/assets/twist.json", "Wrung by two turns", "One end of a bar turns twice."}};
  choices.extreme = {{"/assets/extreme/patch.json", "Patch test", "Every node inside has to find the same shape."}};
  choices.recent = {{"/scenes/liver.obj", "liver.obj", "/scenes"},
                    {"/scenes/gone.json", "gone.json", "/scenes", nullptr, false, false}};
  choices.folder = "/scenes/mine";
  choices.files = {{"/scenes", "..", "parent folder", nullptr, true},
                   {"/scenes/mine/a.jsonl", "a.jsonl", "recording, 2 kB"}};
  return choices;
}

/// Opens the dialog and draws until its layout settles.
void open(Driver& driver) {
  driver.panel.set_choices(some_choices());
  driver.panel.perform(Action::open);
  CHECK(driver.draw().requests == std::vector{Request::list});
  for (int k = 0; k < 3; ++k) driver.draw();
}

void type(Driver& driver, const char* text) {
  ImGui::GetIO().AddInputCharactersUTF8(text);
  for (int k = 0; k < 2; ++k) driver.draw();
}

panel::PanelActions press(Driver& driver, Action key) {
  driver.panel.perform(key);
  return driver.draw();
}

/// Moves the mouse over the whole image until it is on a cell or line of that title.
bool shows(Driver& driver, const std::string& title) {
  for (float x = 100; x < 1240; x += 60)
    for (float y = 60; y < 740; y += 9) {
      driver.move({x, y});
      driver.draw();
      if (driver.panel.hovered() == title) return true;
    }
  return false;
}

}  // namespace

TEST_CASE("the open dialog lists scenes, recent files and a folder, and a click opens") {
  Driver driver;
  CHECK_FALSE(driver.panel.is_modal());
  open(driver);
  CHECK(driver.panel.is_modal());
  CHECK(driver.panel.covers(640, 360));
  REQUIRE(shows(driver, "Cantilever"));
  const auto actions = driver.click();
  CHECK(actions.open == std::filesystem::path("/assets/beam.json"));
  CHECK_FALSE(driver.panel.is_modal());
}

TEST_CASE("a click lists a folder and does not open a missing file") {
  Driver driver;
  open(driver);
  REQUIRE(shows(driver, "gone.json"));
  CHECK_FALSE(driver.click().open);
  CHECK(driver.panel.is_modal());
  REQUIRE(shows(driver, ".."));
  const auto actions = driver.click();
  CHECK(actions.list_folder == std::filesystem::path("/scenes"));
  CHECK_FALSE(actions.open);
  CHECK(driver.panel.is_modal());
}

TEST_CASE("typing filters, arrows select and Enter opens") {
  Driver driver;
  open(driver);
  type(driver, "TURNS bar");
  CHECK(shows(driver, "Wrung by two turns"));
  CHECK_FALSE(shows(driver, "Cantilever"));
  driver.away();
  CHECK(press(driver, Action::open_selected).open == std::filesystem::path("/assets/twist.json"));
  open(driver);
  press(driver, Action::select_next);
  press(driver, Action::select_next);
  CHECK(press(driver, Action::open_selected).open == std::filesystem::path("/assets/beam.json"));
  open(driver);
  type(driver, "/data/x.msh");
  CHECK(press(driver, Action::open_selected).open == std::filesystem::path("/data/x.msh"));
}

TEST_CASE("Esc closes the open dialog without releasing the tool and other keys are ignored meanwhile") {
  Driver driver;
  open(driver);
  driver.panel.perform(Action::toggle_play);
  CHECK(driver.draw().requests.empty());
  driver.panel.perform(Action::release);
  CHECK(driver.draw().requests.empty());
  CHECK_FALSE(driver.panel.is_modal());
  CHECK_FALSE(driver.panel.covers(640, 360));
}

TEST_CASE("a click outside the open dialog closes it") {
  Driver driver;
  open(driver);
  driver.move({4, 400});
  CHECK_FALSE(driver.click().open);
  CHECK_FALSE(driver.panel.is_modal());
}

TEST_CASE("a small image shows the open dialog in one column that scrolls") {
  Driver driver(small_scene(), 640, 360, 0.72f);
  open(driver);
  driver.move({320, 200});
  for (int k = 0; k < 60; ++k) {
    ImGui::GetIO().MouseWheel = -1;
    driver.draw();
  }
  ImGui::GetIO().MouseWheel = 0;
  driver.find("a.jsonl", 100);
  CHECK(driver.click().open == std::filesystem::path("/scenes/mine/a.jsonl"));
}

}  // namespace heml::open_dialog_test
