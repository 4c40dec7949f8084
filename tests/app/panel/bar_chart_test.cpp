#include <app/panel/bar_chart.hpp>
#include <cmath>
#include <limits>

#include "driver.hpp"

namespace heml::bar_chart_test {

using namespace heml::panel;

namespace {

const Area place{{100, 50}, {700, 450}};
constexpr ImU32 ink = colours::rgba(0xff00ff), other_ink = colours::rgba(0x00ffff);

struct Extent {
  float left = 1e9f, right = -1e9f, top = 1e9f, bottom = -1e9f;
  int corners = 0;
};

/// Bounding box of what is drawn in a colour.
Extent drawn(const BarChart& chart, ImU32 colour) {
  test::ImguiContext context(1280, 720, 1);
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  draw_bars(list, place, chart, light_chart);
  Extent extent;
  for (const ImDrawVert& v : list.VtxBuffer) {
    CHECK(std::isfinite(v.pos.x));
    CHECK(std::isfinite(v.pos.y));
    if (v.col != colour) continue;
    extent.left = std::min(extent.left, v.pos.x), extent.right = std::max(extent.right, v.pos.x);
    extent.top = std::min(extent.top, v.pos.y), extent.bottom = std::max(extent.bottom, v.pos.y);
    ++extent.corners;
  }
  ImGui::Render();
  return extent;
}

BarChart chart_of(std::vector<BarChart::Group> groups) {
  BarChart chart;
  chart.title = "A title";
  chart.subtitle = "and what is under it";
  chart.names = {"one", "two"};
  chart.colours = {ink, other_ink};
  chart.groups = std::move(groups);
  chart.mark = 1;
  return chart;
}

}  // namespace

TEST_CASE("bars stay within the area, the longest for the largest value") {
  const BarChart chart = chart_of({{"short", {1, 2}}, {"long", {3, 8}}});
  const Extent one = drawn(chart, ink), two = drawn(chart, other_ink);
  CHECK(one.left >= place.from.x);
  CHECK(two.right <= place.to.x);
  CHECK(one.top >= place.from.y);
  CHECK(two.bottom <= place.to.y);
  CHECK(two.right > one.right);
  CHECK(one.corners == 4 * 3);  // in the legend and two bars
}

TEST_CASE("values without a length have no bar") {
  for (const double value :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CAPTURE(value);
    CHECK(drawn(chart_of({{"one", {value, 2}}}), ink).corners == 4);
    drawn(chart_of({{"one", {value, value}}}), ink);
  }
  CHECK(drawn(chart_of({}), ink).corners == 4);
}

}  // namespace heml::bar_chart_test
