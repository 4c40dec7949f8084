#include <doctest/doctest.h>

#include <cmath>
#include <heml/scenario/standard_view.hpp>
#include <string>

namespace heml::standard_view_test {

TEST_CASE("opposite views are in pairs of opposite names and angles") {
  const auto name = [](StandardView view) { return std::string(standard_view_names[static_cast<std::size_t>(view)]); };
  CHECK(name(opposite(StandardView::front)) == "back");
  CHECK(name(opposite(StandardView::left)) == "right");
  CHECK(name(opposite(StandardView::bottom)) == "top");
  for (std::size_t k = 0; k < standard_view_names.size(); ++k) {
    const auto view = static_cast<StandardView>(k);
    const ViewAngles here = angles_of(view), there = angles_of(opposite(view));
    CHECK(opposite(opposite(view)) == view);
    CHECK(here.elevation == -there.elevation);
    if (here.elevation == 0) CHECK(std::abs(here.azimuth - there.azimuth) == 180);
  }
}

}  // namespace heml::standard_view_test
