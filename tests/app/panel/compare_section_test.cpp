#include "driver.hpp"

namespace heml::beside_section_test {

using namespace heml::test;

namespace {

using Ways = std::vector<std::string>;

/// A panel tall enough for all sections, with "Compare" open.
struct Open : Driver {
  Open() : Driver(small_scene(), 1280, 1600) { click("Compare"); }

  /// The comparisons that the panel asks for when a button is pressed.
  std::optional<Ways> press(const std::string& label) { return click(label, 60).comparisons; }

  void set_beside(const std::string& variant, double distance) {
    Frame body = frame;
    body.variant = variant;
    body.comparisons.clear();
    body.distance = Distance{distance, 2 * distance};
    frame.comparisons.push_back(body);
    draw();
  }
};

}  // namespace

TEST_CASE("a law, a method or both are set beside the body, and what is there stays") {
  Open driver;
  driver.choose("Other law", "ogden");
  CHECK(driver.press("Add comparison") == Ways{"ogden"});
  driver.set_beside("ogden", 1e-3);
  driver.choose("Other law", "stvk");
  driver.choose("Other method", "tr_bdf2");
  CHECK(driver.press("Add comparison") == Ways{"ogden", "stvk+tr_bdf2"});
  driver.set_beside("stvk+tr_bdf2", 2e-3);
  driver.choose("Other method", "bdf2");
  CHECK(driver.press("Add comparison") == Ways{"ogden", "stvk+tr_bdf2", "bdf2"});
}

TEST_CASE("nothing is set beside that is as the body is") {
  Open driver;
  CHECK_FALSE(driver.press("Add comparison"));
}

TEST_CASE("what is beside has a row, and is taken away with one press") {
  Open driver;
  driver.set_beside("ogden", 1e-3);
  driver.find("ogden");
  CHECK(driver.press("Remove comparisons") == Ways{});
}

}  // namespace heml::beside_section_test
