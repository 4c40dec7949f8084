#include <app/panel/decimal_comma.hpp>

#include "driver.hpp"

namespace heml::decimal_comma_test {

using namespace heml::test;
using panel::with_decimal_point;

TEST_CASE("a number that is pasted may have a decimal comma, and groups of thousands") {
  CHECK(with_decimal_point("2,5") == "2.5");
  CHECK(with_decimal_point("-2.5e-3") == "-2.5e-3");
  CHECK(with_decimal_point("1.234,5") == "1234.5");
  CHECK(with_decimal_point("1,234.5") == "1234.5");
  CHECK(with_decimal_point("1,234,567") == "1234567");
  CHECK(with_decimal_point("") == "");
}

TEST_CASE("a slider and a field take a pasted decimal comma, and the clipboard stays") {
  constexpr int key_v = 86;
  const auto paste = [](Driver& driver) {
    ImGuiIO& io = ImGui::GetIO();
    ImGui::SetClipboardText("2,5");
    io.KeyMap[ImGuiKey_V] = key_v;
    io.KeyCtrl = io.KeysDown[key_v] = true;
    io.KeyMods = ImGuiKeyModFlags_Ctrl;
    driver.draw();
    io.KeyCtrl = io.KeysDown[key_v] = false;
    io.KeyMods = 0;
    driver.draw();
    CHECK(std::string(ImGui::GetClipboardText()) == "2,5");
    driver.away();
    const auto commands = driver.click().commands;
    REQUIRE(commands.size() == 1);
    return commands[0];
  };
  Driver driver;
  driver.find("Damping");
  ImGui::GetIO().KeyCtrl = true;
  ImGui::GetIO().KeyMods = ImGuiKeyModFlags_Ctrl;
  driver.click();
  ImGui::GetIO().KeyCtrl = false;
  ImGui::GetIO().KeyMods = 0;
  CHECK(std::get<SetDamping>(paste(driver)).damping == doctest::Approx(2.5));
  driver.choose("Direction", "x, y, z");
  driver.find("Gravity x, y, z", 130);
  driver.click();
  CHECK(std::get<SetGravity>(paste(driver)).gravity.x() == doctest::Approx(2.5));
}

}  // namespace heml::decimal_comma_test
