#include <app/panel/chart.hpp>
#include <cmath>
#include <limits>

#include "driver.hpp"

namespace heml::chart_test {

using namespace heml::panel;

namespace {

const Area place{{100, 50}, {700, 450}};
constexpr ImU32 ink = colours::rgba(0xff00ff);

/// Vertices of what is drawn in a colour.
std::vector<ImVec2> drawn(const Chart& chart, ImU32 colour = ink) {
  test::ImguiContext context(1280, 720, 1);
  ImGui::NewFrame();
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  draw_chart(list, place, chart, light_chart);
  std::vector<ImVec2> corners;
  for (const ImDrawVert& v : list.VtxBuffer) {
    CHECK(std::isfinite(v.pos.x));
    CHECK(std::isfinite(v.pos.y));
    if (v.col == colour) corners.push_back(v.pos);
  }
  ImGui::Render();
  return corners;
}

Chart chart_of(std::vector<ChartPoint> points, ChartMark mark = ChartMark::line) {
  Chart chart;
  chart.title = "A title";
  chart.subtitle = "and what is under it";
  chart.x_label = "Stretch";
  chart.y_quantity = "Stress";
  chart.y_unit = "Pa";
  chart.series.push_back({"", std::move(points), ink, mark, 1});
  return chart;
}

}  // namespace

TEST_CASE("curves stay within the area, the right way up") {
  for (const bool small : {false, true}) {
    Chart chart = chart_of({{0.8, -2e3}, {1, 0}, {1.3, 9e3}});
    chart.small = small;
    const auto corners = drawn(chart);
    REQUIRE(corners.size() >= 6);
    ImVec2 left = corners.front(), right = left;
    for (const ImVec2& c : corners) {
      CHECK(place.contains(c.x, c.y));
      if (c.x < left.x) left = c;
      if (c.x > right.x) right = c;
    }
    CHECK(left.y > right.y + 100);  // the larger stress is higher up
    CHECK(right.x - left.x > 400);
  }
}

TEST_CASE("labels of ticks are left out where they would overlap, but one") {
  using Chosen = std::vector<std::size_t>;
  const std::vector<float> places{0, 10, 20, 30, 40}, narrow(5, 8), wide(5, 15);
  CHECK(labelled_ticks(places, narrow, 1, 2) == Chosen{0, 1, 2, 3, 4});
  CHECK(labelled_ticks(places, narrow, 5, 2) == Chosen{0, 2, 4});
  CHECK(labelled_ticks(places, wide, 1, 1) == Chosen{1, 3});
  CHECK(labelled_ticks(places, std::vector<float>(5, 100), 1, 3) == Chosen{3});
  CHECK(labelled_ticks(std::vector<float>{40, 30, 20}, std::vector<float>(3, 15), 1, 0) == Chosen{0, 2});  // upwards
  CHECK(labelled_ticks({}, {}, 1, 0).empty());
}

TEST_CASE("the numbers of a small chart do not overlap") {
  for (const float width : {120.0f, 200.0f, 280.0f}) {
    CAPTURE(width);
    test::ImguiContext context(1280, 720, 1);
    ImGui::NewFrame();
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    Chart chart = chart_of({{0.7, -9.7e3}, {1, 0}, {1.5, 9.9e3}});
    chart.small = true;
    draw_chart(list, {{100, 50}, {100 + width, 143}}, chart, light_chart);
    std::vector<ImVec2> corners;  // four of each letter, the first at its upper left
    for (const ImDrawVert& v : list.VtxBuffer)
      if (v.col == light_chart.muted) corners.push_back(v.pos);
    REQUIRE(corners.size() % 4 == 0);
    REQUIRE(corners.size() > 40);
    for (std::size_t a = 0; a < corners.size(); a += 4)
      for (std::size_t b = 0; b < a; b += 4) {
        constexpr float touching = 1.5f;  // pixels: letters of a word do
        const bool apart = corners[a].x >= corners[b + 2].x - touching || corners[b].x >= corners[a + 2].x - touching ||
                           corners[a].y >= corners[b + 2].y - touching || corners[b].y >= corners[a + 2].y - touching;
        CHECK(apart);
      }
    ImGui::Render();
  }
}

TEST_CASE("points that are not finite are omitted and a chart without points is empty") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  CHECK(drawn(chart_of({{1, nan}, {infinite, 2}})).empty());
  CHECK(drawn(chart_of({})).empty());
  CHECK_FALSE(drawn(chart_of({{1, 2}, {nan, 3}, {2, 5}})).empty());
  CHECK_FALSE(drawn(chart_of({{1, 0}, {1, 0}}, ChartMark::dots)).empty());  // no extent
}

TEST_CASE("a band is clipped to the axis") {
  Chart chart = chart_of({{1, 0}, {2, 1}});
  chart.band = {1.5, 9, ""};
  const auto corners = drawn(chart, light_chart.band);
  REQUIRE_FALSE(corners.empty());
  for (const ImVec2& c : corners) CHECK(place.contains(c.x, c.y));
  chart.band = {5, 9, ""};
  CHECK(drawn(chart, light_chart.band).empty());
}

TEST_CASE("equal factors are equal lengths on logarithmic axes and points that are not positive are omitted") {
  Chart chart = chart_of({{0, 1}, {1, -1}, {1, 1e-15}, {1e3, 1e-9}, {1e6, 1e-3}}, ChartMark::dots);
  chart.logarithmic = true;
  chart.y_unit.clear();
  const auto corners = drawn(chart);
  std::vector<ImVec2> centres;  // dots are far apart
  std::vector<int> count;
  for (const ImVec2& corner : corners) {
    std::size_t k = 0;
    while (k < centres.size() &&
           std::hypot(centres[k].x / float(count[k]) - corner.x, centres[k].y / float(count[k]) - corner.y) > 30)
      ++k;
    if (k == centres.size()) centres.push_back({0, 0}), count.push_back(0);
    centres[k].x += corner.x, centres[k].y += corner.y, ++count[k];
  }
  REQUIRE(centres.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) centres[k].x /= float(count[k]), centres[k].y /= float(count[k]);
  CHECK(centres[1].x - centres[0].x == doctest::Approx(centres[2].x - centres[1].x).epsilon(0.02));
  CHECK(centres[1].y - centres[0].y == doctest::Approx(centres[2].y - centres[1].y).epsilon(0.02));
  CHECK(centres[2].x > centres[0].x);
  CHECK(centres[2].y < centres[0].y);
}

}  // namespace heml::chart_test
