#include <fmt/format.h>

#include <algorithm>
#include <app/panel/legend.hpp>
#include <app/panel/rows.hpp>
#include <app/panel/theme.hpp>
#include <heml/world/field_list.hpp>

namespace heml::panel {
namespace {

constexpr int colour_steps = 48;

ImU32 colour_at(Field field, float place) {
  const Vec3f c = render::map_colour(field, place);
  return ImGui::ColorConvertFloat4ToU32({c.x(), c.y(), c.z(), 1});
}

/// Draws the colour map from `first` (0 to 1) to its end.
void draw_bar(ImDrawList& list, Field field, float first, const Area& bar) {
  for (int i = 0; i < colour_steps; ++i) {
    const float a = static_cast<float>(i) / colour_steps, b = static_cast<float>(i + 1) / colour_steps;
    const ImU32 left = colour_at(field, first + a * (1 - first)), right = colour_at(field, first + b * (1 - first));
    list.AddRectFilledMultiColor({bar.from.x + a * bar.width(), bar.from.y}, {bar.from.x + b * bar.width(), bar.to.y},
                                 left, right, right, left);
  }
}

void centred(ImDrawList& list, float x, float y, ImU32 colour, const std::string& text) {
  list.AddText({x - ImGui::CalcTextSize(text.c_str()).x / 2, y}, colour, text.c_str());
}

}  // namespace

render::Range legend_range(Field field, const render::Range& range, bool inverted) {
  const bool may_invert = field == Field::volume_ratio && inverted;
  const bool is_ratio = info(field).scale == FieldScale::about_one && !may_invert;
  return {is_ratio ? std::max(range.low, 0.0f) : range.low, range.high};
}

void draw_legend(Field field, const render::Range& whole, const Area& free, bool inverted) {
  if (field == Field::none) return;
  const render::Range range = legend_range(field, whole, inverted);
  const UseFont small(Font::small);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const render::FieldLabel label = render::field_label(field, range);
  const float width = std::min(em(20), free.width() - em(3)), middle = (free.from.x + free.to.x) / 2;
  const float line = ImGui::GetTextLineHeight(), bottom = free.to.y - em(0.9f);
  const Area bar{{middle - width / 2, bottom - line - em(0.75f)}, {middle + width / 2, bottom - line - em(0.2f)}};
  const float pad = em(0.8f);
  list.AddRectFilled({bar.from.x - pad * 1.4f, bar.from.y - line - pad}, {bar.to.x + pad * 1.4f, bottom + pad * 0.5f},
                     colours::background, em(0.5f));
  std::string title = label.unit.empty() ? label.title : fmt::format("{}, {}", label.title, label.unit);
  if (field == Field::volume_ratio && range.low < 0) title += " (below 0: inverted)";
  centred(list, middle, bar.from.y - line - em(0.25f), colours::text, elided(title, width + 2 * pad));
  draw_bar(list, field, (range.low - whole.low) / (whole.high - whole.low), bar);
  float free_from = 0;  // pixels, after the last number
  for (const float tick : render::ticks({range.low * label.scale, range.high * label.scale})) {
    const float x = bar.from.x + (tick / label.scale - range.low) / (range.high - range.low) * width;
    const std::string number = fmt::format("{:g}", tick);
    const float half = ImGui::CalcTextSize(number.c_str()).x / 2;
    list.AddLine({x, bar.to.y}, {x, bar.to.y + em(0.15f)}, colours::muted);
    if (x - half < free_from) continue;
    centred(list, x, bar.to.y + em(0.15f), colours::muted, number);
    free_from = x + half + em(0.3f);
  }
}

}  // namespace heml::panel
