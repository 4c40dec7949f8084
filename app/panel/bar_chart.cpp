#include <fmt/format.h>

#include <algorithm>
#include <app/panel/bar_chart.hpp>
#include <app/panel/rows.hpp>
#include <app/panel/theme.hpp>
#include <cmath>

namespace heml::panel {
namespace {

class BarDrawing {
 public:
  BarDrawing(ImDrawList& list, const BarChart& chart, const ChartColours& colours)
      : list_(list), chart_(chart), colours_(colours) {
    for (const auto& group : chart.groups) {
      widest_ = std::max(widest_, ImGui::CalcTextSize(group.label.c_str()).x);
      for (const double value : group.values)
        if (std::isfinite(value)) largest_ = std::max(largest_, value);
    }
  }

  void draw(const Area& area) {
    list_.AddRectFilled(area.from, area.to, colours_.paper);
    widest_ = std::min(widest_, max_label_ * area.width());
    const float margin = em(1.4f);
    bars_ = {{area.from.x + margin + widest_ + em(0.7f), draw_head(area.from.x + margin, area.from.y + em(1.0f))},
             {area.to.x - margin - em(3.2f), area.to.y - margin}};
    const float line = bars_.height() / static_cast<float>(std::max<std::size_t>(1, chart_.groups.size()));
    for (std::size_t g = 0; g < chart_.groups.size(); ++g)
      draw_group(chart_.groups[g], bars_.from.y + line * float(g), line);
    if (!chart_.mark) return;
    const float x = std::round(place(*chart_.mark)) + 0.5f;
    list_.AddLine({x, bars_.from.y}, {x, bars_.to.y}, colours_.axis, em(0.07f));
  }

 private:
  void text(float x, float y, ImU32 colour, const std::string& words) {
    list_.AddText({std::round(x), std::round(y)}, colour, words.c_str());
  }

  /// Draws title, subtitle and legend. Returns the y where the bars begin.
  float draw_head(float x, float y) {
    {
      const UseFont font(Font::title);
      text(x, y, colours_.text, chart_.title);
      y += ImGui::GetTextLineHeight() + em(0.15f);
    }
    text(x, y, colours_.muted, chart_.subtitle);
    y += ImGui::GetTextLineHeight() + em(0.5f);
    const float line = ImGui::GetTextLineHeight();
    for (std::size_t k = 0; k < chart_.names.size(); ++k) {
      list_.AddRectFilled({x, y + 0.2f * line}, {x + em(1.2f), y + 0.8f * line}, chart_.colours[k]);
      text(x + em(1.7f), y, colours_.text, chart_.names[k]);
      x += em(3.3f) + ImGui::CalcTextSize(chart_.names[k].c_str()).x;
    }
    return y + line + em(0.8f);
  }

  float place(double value) const {
    return bars_.from.x + static_cast<float>(std::min(value, largest_) / largest_) * bars_.width();
  }

  void draw_group(const BarChart::Group& group, float y, float height) {
    const float middle = y + height / 2, half_text = ImGui::GetTextLineHeight() / 2;
    const std::string label = elided(group.label, widest_);
    text(bars_.from.x - em(0.7f) - ImGui::CalcTextSize(label.c_str()).x, middle - half_text, colours_.text, label);
    const float thick = 0.8f * height / static_cast<float>(std::max<std::size_t>(1, group.values.size()));
    const UseFont font(Font::small);
    for (std::size_t k = 0; k < group.values.size(); ++k) {
      const double value = group.values[k];
      if (!std::isfinite(value) || value <= 0) continue;
      const float top = y + 0.1f * height + thick * static_cast<float>(k), end = place(value);
      list_.AddRectFilled({bars_.from.x, top}, {end, top + 0.9f * thick}, chart_.colours[k]);
      text(end + em(0.3f), top + 0.45f * thick - ImGui::GetTextLineHeight() / 2, colours_.muted,
           fmt::format("{:.3g}", value));
    }
  }

  static constexpr float max_label_ = 0.5f;  // of the width; longer labels end in an ellipsis

  ImDrawList& list_;
  const BarChart& chart_;
  const ChartColours& colours_;
  float widest_ = 0;
  double largest_ = 1e-300;
  Area bars_{};
};

}  // namespace

void draw_bars(ImDrawList& list, const Area& area, const BarChart& chart, const ChartColours& colours) {
  BarDrawing(list, chart, colours).draw(area);
}

}  // namespace heml::panel
