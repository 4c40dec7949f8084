#include <app/panel/region_section.hpp>

#include "driver.hpp"

namespace heml::region_section_test {

using namespace heml::test;

namespace {
const std::vector<int> regions{1, 2, 5};
using Hidden = std::vector<int>;
}  // namespace

TEST_CASE("regions are hidden and shown, but never all hidden") {
  panel::RegionSection section(regions, {}, {});
  section.toggle(5);
  section.toggle(1);
  CHECK(section.hidden() == Hidden{1, 5});
  section.toggle(2);
  CHECK(section.hidden() == Hidden{1, 5});
  section.toggle(1);
  CHECK(section.hidden() == Hidden{5});
}

TEST_CASE("one region alone, and all again") {
  panel::RegionSection section(regions, {}, {2});
  section.show_only(2);
  CHECK(section.hidden() == Hidden{1, 5});
  section.show_only(5);
  CHECK(section.hidden() == Hidden{1, 2});
  section.show_only(5);
  CHECK(section.hidden().empty());
}

TEST_CASE("a scene that hides every region, or one that is not there, shows what there is") {
  CHECK(panel::RegionSection(regions, {}, {1, 2, 5}).hidden().empty());
  CHECK(panel::RegionSection(regions, {}, {2, 7}).hidden() == Hidden{2});
}

TEST_CASE("eyes and names in the panel") {
  Scene scene = small_scene();
  Driver driver(scene, 1280, 1000, 1, {{2, "tumour"}}, {0, 2});
  driver.click("Regions");
  driver.click("Eye of tumour", 30);
  CHECK(driver.panel.hidden_regions() == Hidden{2});
  driver.panel.write_into(scene);
  CHECK(scene.view.hidden == Hidden{2});
  driver.click("Show all");
  CHECK(driver.panel.hidden_regions().empty());
  driver.click("Only tumour", 260);
  CHECK(driver.panel.hidden_regions() == Hidden{0});
}

}  // namespace heml::region_section_test
