#include <doctest/doctest.h>

#include <app/panel/legend.hpp>

#include "driver.hpp"

namespace heml::legend_test {

using namespace heml::test;
using panel::legend_range;

TEST_CASE("the legend starts at 0 for stretch and below 0 only for inverted volume ratios") {
  const render::Range wide{-1.5f, 3.5f};
  CHECK(legend_range(Field::stretch, wide, false).low == 0);
  CHECK(legend_range(Field::stretch, wide, true).low == 0);
  CHECK(legend_range(Field::volume_ratio, wide, false).low == 0);
  CHECK(legend_range(Field::volume_ratio, wide, true).low == -1.5f);
  CHECK(legend_range(Field::volume_ratio, {0.9f, 1.1f}, false).low == 0.9f);
  CHECK(legend_range(Field::stretch, wide, false).high == 3.5f);
}

TEST_CASE("in a small image with large text the palette covers nothing of the legend and the hints") {
  Driver driver(small_scene(), 800, 500, 1.44f);
  driver.frame.field = Field::displacement;
  driver.frame.values = {0, 0.01f, 0.02f, 0.03f};
  for (int k = 0; k < 3; ++k) driver.draw();
  ImGui::NewFrame();
  driver.panel.draw(driver.frame);
  const ImDrawList& marks = *ImGui::GetBackgroundDrawList();
  REQUIRE(marks.VtxBuffer.Size > 0);
  int covered = 0;
  for (const ImDrawVert& vertex : marks.VtxBuffer) covered += driver.panel.covers(vertex.pos.x, vertex.pos.y);
  CHECK(covered == 0);
  ImGui::Render();
}

}  // namespace heml::legend_test
