#include <doctest/doctest.h>

#include <app/panel/preferences.hpp>

namespace heml::preferences_test {

using namespace heml::panel;

TEST_CASE("preferences come back from their text") {
  const Preferences kept{false, {{"Tool force", true}, {"Motion", false}}};
  CHECK(preferences_from(to_text(kept)) == kept);
  CHECK(preferences_from(to_text(Preferences{})) == Preferences{});
  CHECK(to_text(Preferences{}).empty());
  Preferences device;
  device.device_moves_view = true;
  CHECK(preferences_from(to_text(device)) == device);
}

TEST_CASE("lines that are not understood are skipped") {
  CHECK(preferences_from("hints blue\n\nclosed Motion\nopened\n") == Preferences{true, {{"Motion", false}}});
}

}  // namespace heml::preferences_test
