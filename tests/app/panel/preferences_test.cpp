#include <doctest/doctest.h>

#include <app/panel/preferences.hpp>

namespace heml::preferences_test {

using namespace heml::panel;

TEST_CASE("preferences come back from their text") {
  Preferences kept;
  kept.hints = kept.constraints = kept.full_resolution = false;
  kept.look = {1.25, Theme::light};
  kept.window = {1600, 900};
  kept.tools = {{"jaw length", 0.125}, {"depth", 0}};
  kept.sections = {{"Tool force", true}, {"Motion", false}};
  CHECK(preferences_from(to_text(kept)) == kept);
  CHECK(preferences_from(to_text(Preferences{})) == Preferences{});
  CHECK(to_text(Preferences{}).empty());
  Preferences device;
  device.device_moves_view = true;
  CHECK(preferences_from(to_text(device)) == device);
}

TEST_CASE("lines that are not understood are skipped") {
  Preferences closed;
  closed.sections = {{"Motion", false}};
  CHECK(preferences_from("hints blue\n\nclosed Motion\nopened\nsize 40\nsize nan\nsize 1.25x\ntheme pink\n"
                         "tool\ntool 3\ntool depth\ntool depth inf\ntool depth 1e999\n"
                         "window\nwindow 1600\nwindow 0 900\nwindow 1600 -900\nwindow 99999 900\n") == closed);
}

}  // namespace heml::preferences_test
