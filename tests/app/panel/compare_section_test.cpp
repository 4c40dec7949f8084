#include "driver.hpp"

namespace heml::compare_section_test {

using namespace heml::test;

namespace {

using panel::variant_title;
using Variants = std::vector<std::string>;

/// A panel tall enough for all sections, with "Compare" open.
struct Open : Driver {
  Open() : Driver(small_scene(), 1280, 1600) { click("Compare"); }

  /// The comparisons that the panel asks for when a button is pressed.
  std::optional<Variants> press(const std::string& label) { return click(label, 60).comparisons; }

  void add_comparison_run(const std::string& variant, double distance) {
    Frame body = frame;
    body.variant = variant;
    body.comparisons.clear();
    body.distance = Distance{distance, 2 * distance};
    frame.comparisons.push_back(body);
    draw();
  }
};

}  // namespace

TEST_CASE("a comparison by law, by integrator or both is added to those that exist") {
  Open driver;
  driver.choose("Other law", variant_title("ogden"));
  CHECK(driver.press("Add comparison") == Variants{"ogden"});
  driver.add_comparison_run("ogden", 1e-3);
  driver.choose("Other law", variant_title("stvk"));
  driver.choose("Other method", variant_title("tr_bdf2"));
  CHECK(driver.press("Add comparison") == Variants{"ogden", "stvk+tr_bdf2"});
  driver.add_comparison_run("stvk+tr_bdf2", 2e-3);
  driver.choose("Other method", variant_title("bdf2"));
  CHECK(driver.press("Add comparison") == Variants{"ogden", "stvk+tr_bdf2", "bdf2"});
}

TEST_CASE("variants have titles and no internal names") {
  CHECK(variant_title("stvk+tr_bdf2") ==
        std::string(find_law("stvk")->title) + ", " + std::string(info_of(Integrator::tr_bdf2).title));
  CHECK(variant_title("stvk, verlet") == variant_title("stvk+verlet"));
  CHECK(variant_title("float") == "float");
}

TEST_CASE("a comparison equal to the body is not added") {
  Open driver;
  CHECK_FALSE(driver.press("Add comparison"));
}

TEST_CASE("a comparison has a row and one button removes all") {
  Open driver;
  driver.add_comparison_run("ogden", 1e-3);
  driver.find(variant_title("ogden"));
  CHECK(driver.press("Remove comparisons") == Variants{});
}

}  // namespace heml::compare_section_test
