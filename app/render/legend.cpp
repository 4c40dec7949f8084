#include "app/render/legend.hpp"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace heml::render {
namespace {

constexpr int strips = 48;  // of the bar

ImU32 colour_at(Field field, float place) {
  const Vec3f c = map_colour(field, place);
  return ImGui::ColorConvertFloat4ToU32({c.x(), c.y(), c.z(), 1});
}

void draw_bar(ImDrawList& list, Field field, ImVec2 top_left, ImVec2 bottom_right) {
  const float height = bottom_right.y - top_left.y;
  for (int i = 0; i < strips; ++i) {
    const float low = static_cast<float>(i) / strips, high = static_cast<float>(i + 1) / strips;
    const ImU32 below = colour_at(field, low), above = colour_at(field, high);
    list.AddRectFilledMultiColor({top_left.x, bottom_right.y - high * height},
                                 {bottom_right.x, bottom_right.y - low * height}, above, above, below, below);
  }
}

// As many decimals as the distance between ticks needs.
std::string tick_text(float value, float distance) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(distance) - 1e-4f)), 0, 6);
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

void draw_legend(ImDrawList& list, Field field, const Range& range, Size size) {
  if (field == Field::none) return;
  const FieldLabel label = field_label(field, range);
  const std::string title = label.unit.empty() ? label.title : fmt::format("{} [{}]", label.title, label.unit);
  const Range shown{range.low * label.scale, range.high * label.scale};
  const float text = ImGui::GetFontSize(), pad = 0.8f * text;
  const float height = std::min(16 * text, 0.5f * static_cast<float>(size.height));
  const float width = std::max(ImGui::CalcTextSize(title.c_str()).x, 5 * text) + 2 * pad;
  const ImVec2 corner(static_cast<float>(size.width) - width - pad, pad);
  const ImVec2 bar(corner.x + pad, corner.y + pad + 1.7f * text);
  const ImVec2 bar_end(bar.x + 1.1f * text, bar.y + height);
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);

  list.AddRectFilled(corner, {corner.x + width, bar_end.y + pad}, ImGui::GetColorU32(ImGuiCol_WindowBg), 8);
  list.AddText({bar.x, corner.y + 0.8f * pad}, ink, title.c_str());
  draw_bar(list, field, bar, bar_end);
  const std::vector<float> places = ticks(shown);
  const float distance = places.size() > 1 ? places[1] - places[0] : 1;
  for (const float value : places) {
    const float y = bar_end.y - (value - shown.low) / std::max(shown.high - shown.low, 1e-30f) * height;
    list.AddLine({bar_end.x, y}, {bar_end.x + 0.35f * text, y}, ink);
    list.AddText({bar_end.x + 0.6f * text, y - 0.5f * text}, ink, tick_text(value, distance).c_str());
  }
}

}  // namespace heml::render
