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

/// On a ground of its own, so that no curve strikes it through.
void draw_label(ImDrawList& list, const ImVec2& at, ImU32 colour, const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float margin = em(0.15f);
  list.AddRectFilled({at.x - margin, at.y}, {at.x + size.x + margin, at.y + size.y},
                     (colours::chart & 0x00ffffff) | 0xb0000000);
  list.AddText(at, colour, text.c_str());
}

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
  const PlotCanvas canvas{
      {from.x, from.y + inset}, {to.x, to.y - inset}, readings.back().time, axis_of(readings, curves, style)};
  const float base = canvas.at(canvas.latest, style.base).y;
  list.AddLine({from.x, base}, {to.x, base}, (colours::faint & 0x00ffffff) | 0x5a000000);
  list.PushClipRect(from, to, true);
  for (const Curve& curve : curves) draw_curve(list, canvas, readings, curve);
  list.PopClipRect();
  const UseFont small(Font::small);
  const float margin = em(0.3f);
  const float bottom = to.y - ImGui::GetTextLineHeight() - margin * 0.2f;
  const std::string span = fmt::format("last {:.0f} s", History::span);
  draw_label(list, {from.x + margin, from.y + margin * 0.2f}, colours::muted, text_of(canvas.axis.high, style.unit));
  draw_label(list, {from.x + margin, bottom}, colours::muted, text_of(canvas.axis.low, style.unit));
  draw_label(list, {to.x - margin - ImGui::CalcTextSize(span.c_str()).x, bottom}, colours::faint, span);
  if (ImGui::IsItemHovered() && !ImGui::IsAnyMouseDown()) draw_tooltip(list, canvas, readings, curves, style.unit);
}

}  // namespace heml::panel
