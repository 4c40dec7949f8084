#include <fmt/format.h>

#include <algorithm>
#include <app/panel/plot.hpp>
#include <app/panel/quantity.hpp>
#include <cmath>
#include <vector>

namespace heml::panel {
namespace {

struct Axis {
  double low, high;
};

std::string text_of(double value, std::string_view unit) {
  if (!std::isfinite(value)) return "–";
  if (unit.empty()) return fmt::format("{:.3f}", value);
  const bool takes_prefix = unit != "%" && unit != "×" && unit != "mm" && unit != "°";
  return takes_prefix ? quantity(value, unit) : fmt::format("{:.3g} {}", value, unit);
}

/// The smallest of 1, 1.5, 2, 3, 5, 7 times a power of ten at or above the value, so that the axis changes seldom.
double rounded_up(double value) {
  if (!(value > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0})
    if (step * power >= value) return step * power;
  return 10 * power;
}

Axis axis_of(const std::deque<Reading>& readings, std::span<const Curve> curves, const PlotStyle& style) {
  double above = 0, below = 0;
  for (const Reading& reading : readings)
    for (const Curve& curve : curves) {
      const double distance = curve.value(reading) - style.base;
      if (!std::isfinite(distance)) continue;
      above = std::max(above, distance);
      below = std::max(below, -distance);
    }
  Axis axis{style.base - rounded_up(below), style.base + rounded_up(above)};
  if (axis.high - axis.low < style.min_range) axis.high = axis.low + style.min_range;
  return axis.high > axis.low ? axis : Axis{style.base, style.base + 1};
}

/// A rectangle on the screen, pixels, and the mapping of times and values into it.
struct PlotCanvas {
  ImVec2 from, to;
  double latest;
  Axis axis;
  ImVec2 at(double time, double value) const {
    const double x = 1 - (latest - time) / History::span;
    const double y = std::clamp((value - axis.low) / (axis.high - axis.low), -0.05, 1.05);
    return {from.x + static_cast<float>(x) * (to.x - from.x), to.y - static_cast<float>(y) * (to.y - from.y)};
  }
};

void draw_curve(ImDrawList& list, const PlotCanvas& canvas, const std::deque<Reading>& readings, const Curve& curve) {
  static thread_local std::vector<ImVec2> points;
  points.clear();
  for (const Reading& reading : readings)
    if (const double value = curve.value(reading); std::isfinite(value))
      points.push_back(canvas.at(reading.time, value));
  list.AddPolyline(points.data(), static_cast<int>(points.size()), curve.colour, ImDrawFlags_None, em(0.09f));
}

void draw_tooltip(ImDrawList& list, const PlotCanvas& canvas, const std::deque<Reading>& readings,
                  std::span<const Curve> curves, std::string_view unit) {
  const float place = (ImGui::GetIO().MousePos.x - canvas.from.x) / (canvas.to.x - canvas.from.x);
  const double time = canvas.latest - History::span * (1 - static_cast<double>(place));
  const auto found =
      std::lower_bound(readings.begin(), readings.end(), time, [](const Reading& r, double t) { return r.time < t; });
  if (found == readings.end() || readings.front().time > time) return;
  const float x = canvas.at(found->time, 0).x;
  list.AddLine({x, canvas.from.y}, {x, canvas.to.y}, colours::faint);
  ImGui::BeginTooltip();
  ImGui::TextDisabled("%.2f s", found->time);
  for (const Curve& curve : curves) {
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(curve.colour), "%s", curve.name);
    ImGui::SameLine(em(5));
    ImGui::TextUnformatted(text_of(curve.value(*found), unit).c_str());
  }
  ImGui::EndTooltip();
}

/// What stands beside the curves: both ends of the vertical axis at their left, the time under them.
struct Labels {
  std::string high, low, time;
  ImVec2 room;  ///< pixels that they take of width and height

  Labels(const Axis& axis, std::string_view unit)
      : high(text_of(axis.high, unit)),
        low(text_of(axis.low, unit)),
        time(fmt::format("last {:.0f} s", History::span)),
        room(std::max(em(min_width), std::max(width_of(high), width_of(low)) + em(2 * margin)),
             ImGui::GetTextLineHeight() + em(margin / 2)) {}

  void draw(ImDrawList& list, const ImVec2& from, const ImVec2& to) const {
    const float left = from.x + em(margin), bottom = to.y - ImGui::GetTextLineHeight();
    list.AddText({left, from.y + em(margin / 4)}, colours::muted, high.c_str());
    list.AddText({left, to.y - room.y - ImGui::GetTextLineHeight() / 2}, colours::muted, low.c_str());
    list.AddText({to.x - em(margin) - width_of(time), bottom}, colours::faint, time.c_str());
  }

 private:
  static constexpr float margin = 0.3f, min_width = 3;  // em; curves stay in place while the numbers are short
  static float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }
};

}  // namespace

void plot(const char* id, const History& history, std::span<const Curve> curves, const PlotStyle& style) {
  const std::deque<Reading>& readings = history.readings();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 to(from.x + ImGui::GetContentRegionAvail().x, from.y + em(style.height));
  ImGui::InvisibleButton(id, {to.x - from.x, to.y - from.y});
  if (!ImGui::IsItemVisible()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float rounding = ImGui::GetStyle().FrameRounding;
  list.AddRectFilled(from, to, colours::chart, rounding);
  if (readings.empty()) return;

  const float inset = em(0.35f);
  const Axis axis = axis_of(readings, curves, style);
  const UseFont small(Font::small);
  const Labels labels(axis, style.unit);
  labels.draw(list, from, to);
  const PlotCanvas canvas{
      {from.x + labels.room.x, from.y + inset}, {to.x, to.y - labels.room.y - inset / 2}, readings.back().time, axis};
  const float base = canvas.at(canvas.latest, style.base).y;
  list.AddLine({canvas.from.x, base}, {to.x, base}, (colours::faint & 0x00ffffff) | 0x5a000000);
  list.PushClipRect({canvas.from.x, from.y}, {to.x, to.y - labels.room.y}, true);
  for (const Curve& curve : curves) draw_curve(list, canvas, readings, curve);
  list.PopClipRect();
  if (ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()) draw_tooltip(list, canvas, readings, curves, style.unit);
}

}  // namespace heml::panel
