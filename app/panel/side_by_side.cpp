#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <app/panel/quantity.hpp>
#include <app/panel/side_by_side.hpp>
#include <app/panel/theme.hpp>

namespace heml::panel {
namespace {

std::string distance_text(const Frame& body) {
  if (!body.halted.empty()) return "stopped: " + body.halted;
  if (!body.apart) return "of another surface by now";
  return fmt::format("{} apart in the mean, {} at most", quantity(body.apart->mean, "m"),
                     quantity(body.apart->most, "m"));
}

void draw_line(const std::string& text, const Pane& pane, float down, ImU32 colour) {
  const float left = static_cast<float>(pane.left) + pane.covered.left;
  const float right = static_cast<float>(pane.left + pane.size.width) - pane.covered.right;
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.PushClipRect({left, static_cast<float>(pane.top)}, {right, static_cast<float>(pane.top + pane.size.height)});
  list.AddText({std::max(left + em(0.5f), (left + right - size.x) / 2), static_cast<float>(pane.top) + down}, colour,
               text.c_str());
  list.PopClipRect();
}

}  // namespace

void SideBySide::draw(const Frame& frame, Eye& eye, const render::DrawOptions& options) {
  while (renderers_.size() < bodies_of(frame)) renderers_.push_back(std::make_unique<render::Renderer>());
  each_pane(frame, eye, [&](std::size_t pane, const Frame& body) {
    render::DrawOptions here = options;
    here.left = eye.pane().left;
    here.bottom = eye.size().height - eye.pane().top - eye.pane().size.height;
    if (pane > 0) here.beyond = {};  // which is of the first alone
    renderers_[pane]->draw(body, eye.camera(), here, eye.pane().size);
  });
}

void draw_ways(const Frame& frame, Eye& eye) {
  if (frame.beside.empty()) return;
  each_pane(frame, eye, [&](std::size_t pane, const Frame& body) {
    draw_line(body.way, eye.pane(), em(0.8f), colours::text);
    const UseFont small(Font::small);
    if (pane > 0) draw_line(distance_text(body), eye.pane(), em(2.4f), colours::muted);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto x = static_cast<float>(eye.pane().left), y = static_cast<float>(eye.pane().top);
    if (eye.pane().left > 0)
      list.AddLine({x, y}, {x, y + static_cast<float>(eye.pane().size.height)}, colours::muted, 1);
    if (eye.pane().top > 0) list.AddLine({x, y}, {x + static_cast<float>(eye.pane().size.width), y}, colours::muted, 1);
  });
}

}  // namespace heml::panel
