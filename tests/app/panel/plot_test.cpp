#include <algorithm>
#include <app/panel/plot.hpp>
#include <cmath>

#include "driver.hpp"

namespace heml::plot_test {

using namespace heml::panel;

namespace {

constexpr ImU32 ink = colours::rgba(0xff00ff);

/// A history whose kinetic energy goes through the whole of its plot.
History swinging() {
  History history;
  for (int k = 0; k <= 400; ++k) {
    Frame frame;
    frame.tick = k;
    frame.time = 0.02 * k;
    frame.energies.kinetic = std::sin(3 * frame.time);
    history.add(frame);
  }
  return history;
}

/// The rectangle round the vertices of some colours.
template <class... Colour>
Area bounds(const ImDrawList& list, Colour... colour) {
  Area area{{1e9f, 1e9f}, {-1e9f, -1e9f}};
  for (const ImDrawVert& v : list.VtxBuffer) {
    if (((v.col != colour) && ...)) continue;
    area.from = {std::min(area.from.x, v.pos.x), std::min(area.from.y, v.pos.y)};
    area.to = {std::max(area.to.x, v.pos.x), std::max(area.to.y, v.pos.y)};
  }
  return area;
}

}  // namespace

TEST_CASE("the labels of a plot stand beside its curves") {
  const History history = swinging();
  const Curve curves[] = {{"Kinetic", ink, [](const Reading& r) { return r.energies.kinetic; }}};
  for (const float height : {2.9f, 4.7f}) {
    CAPTURE(height);
    test::ImguiContext context(640, 480, 1);
    ImGui::NewFrame();
    ImGui::SetNextWindowSize({260, 400});
    ImGui::Begin("plots");
    plot("plot", history, curves, {"J", 0, 1e-9, height});
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const Area curve = bounds(list, ink), ends = bounds(list, colours::muted), time = bounds(list, colours::faint);
    CHECK(curve.width() > 150);
    CHECK(curve.height() > em(height - 1.6f));
    CHECK(ends.to.x <= curve.from.x);
    CHECK(ends.from.y <= curve.from.y + em(0.8f));
    CHECK(time.from.y >= curve.to.y - 1);
    CHECK(ends.to.x < time.from.x);
    ImGui::End();
    ImGui::Render();
  }
}

}  // namespace heml::plot_test
