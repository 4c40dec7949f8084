#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <app/panel/compare_section.hpp>
#include <app/panel/comparison_view.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/rows.hpp>
#include <app/panel/theme.hpp>

namespace heml::panel {
namespace {

std::string distance_text(const Frame& body) {
  if (!body.halted.empty()) return "stopped: " + body.halted;
  if (!body.distance) return "topology differs";
  return fmt::format("distance: mean {}, max {}", quantity(body.distance->mean, "m"),
                     quantity(body.distance->max, "m"));
}

void draw_line(const std::string& text, const Pane& pane, float down, ImU32 colour) {
  const float left = static_cast<float>(pane.left) + pane.covered.left;
  const float right = static_cast<float>(pane.left + pane.size.width) - pane.covered.right;
  const std::string shown = elided(text, right - left - em(1));
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({left, static_cast<float>(pane.top)}, {right, static_cast<float>(pane.top + pane.size.height)});
  list.AddText({std::max(left + em(0.5f), (left + right - size.x) / 2), static_cast<float>(pane.top) + down}, colour,
               shown.c_str());
  list.PopClipRect();
}

}  // namespace

void ComparisonView::draw(const Frame& frame, CameraController& controller, const render::DrawOptions& options) {
  while (renderers_.size() < body_count(frame)) renderers_.push_back(std::make_unique<render::Renderer>());
  each_pane(frame, controller, [&](std::size_t pane, const Frame& body) {
    render::DrawOptions here = options;
    here.left = controller.pane().left;
    here.bottom = controller.size().height - controller.pane().top - controller.pane().size.height;
    if (pane > 0) here.hatched = {};  // computed for the body alone
    renderers_[pane]->draw(body, controller.camera(), here, controller.pane().size);
  });
}

void draw_variant_labels(const Frame& frame, CameraController& controller) {
  if (frame.comparisons.empty()) return;
  each_pane(frame, controller, [&](std::size_t pane, const Frame& body) {
    draw_line(variant_title(body.variant), controller.pane(), em(0.8f), colours::text);
    const UseFont small(Font::small);
    if (pane > 0) draw_line(distance_text(body), controller.pane(), em(2.4f), colours::muted);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto x = static_cast<float>(controller.pane().left), y = static_cast<float>(controller.pane().top);
    if (controller.pane().left > 0)
      list.AddLine({x, y}, {x, y + static_cast<float>(controller.pane().size.height)}, colours::muted, 1);
    if (controller.pane().top > 0)
      list.AddLine({x, y}, {x + static_cast<float>(controller.pane().size.width), y}, colours::muted, 1);
  });
}

}  // namespace heml::panel
