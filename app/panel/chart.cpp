#include <fmt/format.h>

#include <algorithm>
#include <app/panel/chart.hpp>
#include <app/panel/rows.hpp>
#include <app/panel/theme.hpp>
#include <app/render/field_colours.hpp>
#include <cmath>
#include <limits>

namespace heml::panel {
namespace {

/// An SI prefix and the factor that converts to it.
struct Prefix {
  const char* text;
  double factor;
};
Prefix prefix_for(double largest) {
  if (largest < 1e-3) return {"µ", 1e6};
  if (largest < 1) return {"m", 1e3};
  if (largest < 1e3) return {"", 1};
  return largest < 1e6 ? Prefix{"k", 1e-3} : Prefix{"M", 1e-6};
}

struct Span {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  void include_value(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high - low; }
};

/// Ranges of the axes: x as given, y in its unit with prefix; on logarithmic axes log10 of both.
struct Axes {
  Span x, y;
  Prefix prefix;
};

/// The ranges in whole decades, so that there are ticks.
Axes logarithmic_axes(const Chart& chart) {
  Axes axes{{}, {}, {"", 1}};
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& p : series.points)
      if (p.x > 0 && p.y > 0) axes.x.include_value(std::log10(p.x)), axes.y.include_value(std::log10(p.y));
  for (const ChartLine& line : chart.vertical) axes.x.include_value(std::log10(line.at));
  for (const ChartLine& line : chart.horizontal) axes.y.include_value(std::log10(line.at));
  if (axes.x.low > axes.x.high) axes.x = {0, 1};
  if (axes.y.low > axes.y.high) axes.y = {0, 1};
  for (Span* span : {&axes.x, &axes.y}) {
    span->low = std::floor(span->low + 1e-9), span->high = std::ceil(span->high - 1e-9);
    if (!(span->size() > 0)) span->high = span->low + 1;
  }
  return axes;
}

Axes axes_of(const Chart& chart) {
  if (chart.logarithmic) return logarithmic_axes(chart);
  Axes axes{{}, {}, {"", 1}};
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& p : series.points)
      if (std::isfinite(p.x) && std::isfinite(p.y)) axes.x.include_value(p.x), axes.y.include_value(p.y);
  if (axes.x.low > axes.x.high) axes.x = {0, 1}, axes.y = {0, 1};
  axes.y.include_value(0);
  axes.prefix = prefix_for(std::max(std::abs(axes.y.low), std::abs(axes.y.high)));
  axes.y.low *= axes.prefix.factor, axes.y.high *= axes.prefix.factor;
  if (!(axes.y.size() > 0)) axes.y.high = axes.y.low + 1;
  if (!(axes.x.size() > 0)) axes.x.high = axes.x.low + 1;
  const double margin = 0.04 * axes.y.size();
  if (axes.y.low < 0) axes.y.low -= margin;
  if (axes.y.high > 0) axes.y.high += margin;
  return axes;
}

class Drawing {
 public:
  Drawing(ImDrawList& list, const Chart& chart, const ChartColours& colours)
      : list_(list), chart_(chart), colours_(colours), axes_(axes_of(chart)) {}

  void draw(const Area& area) {
    list_.AddRectFilled(area.from, area.to, colours_.paper, chart_.small ? ImGui::GetStyle().FrameRounding : 0);
    plot_ = chart_.small ? small_plot(area) : large_plot(area);
    draw_band();
    draw_ticks();
    draw_lines();
    list_.PushClipRect({plot_.from.x - em(0.3f), plot_.from.y - em(0.3f)},
                       {plot_.to.x + em(0.3f), plot_.to.y + em(0.3f)}, true);
    for (const ChartSeries& series : chart_.series) draw_series(series);
    list_.PopClipRect();
  }

 private:
  std::vector<float> ticks(const Span& span) const {
    if (!chart_.logarithmic) return render::ticks({static_cast<float>(span.low), static_cast<float>(span.high)});
    std::vector<float> decades;
    const int every = span.size() > 12 ? 3 : 1;
    for (int d = static_cast<int>(span.low); d <= static_cast<int>(span.high); ++d)
      if (d % every == 0) decades.push_back(static_cast<float>(d));
    return decades;
  }
  std::string number(float value) const {
    if (chart_.logarithmic)
      return std::abs(value) < 3 ? fmt::format("{:g}", std::pow(10.0, value)) : fmt::format("1e{:g}", value);
    return fmt::format("{}{:.5g}", value < -1e-30f ? "−" : "", std::abs(value) < 1e-30f ? 0.0f : std::abs(value));
  }
  /// "Stress, kPa".
  std::string y_label() const {
    const std::string unit = axes_.prefix.text + chart_.y_unit;
    return unit.empty() ? chart_.y_quantity : chart_.y_quantity + ", " + unit;
  }

  void text(float x, float y, ImU32 colour, const std::string& words) {
    list_.AddText({std::round(x), std::round(y)}, colour, words.c_str());
  }

  Area small_plot(const Area& area) {
    const UseFont font(Font::small);
    const float line = ImGui::GetTextLineHeight();
    text(area.from.x + em(0.4f), area.from.y + em(0.15f), colours_.muted, y_label());
    float widest = 0;
    for (const float tick : ticks(axes_.y)) widest = std::max(widest, ImGui::CalcTextSize(number(tick).c_str()).x);
    return {{area.from.x + em(0.6f) + widest, area.from.y + line + em(0.55f)},
            {area.to.x - em(0.7f), area.to.y - line - em(0.5f)}};
  }

  Area large_plot(const Area& area) {
    const float margin = em(1.4f);
    float y = area.from.y + em(1.0f);
    {
      const UseFont font(Font::title);
      text(area.from.x + margin, y, colours_.text, chart_.title);
      y += ImGui::GetTextLineHeight() + em(0.15f);
    }
    if (!chart_.subtitle.empty()) {
      text(area.from.x + margin, y, colours_.muted, elided(chart_.subtitle, area.width() - 2 * margin));
      y += ImGui::GetTextLineHeight() + em(0.3f);
    }
    y = draw_legend({area.from.x + margin, y + em(0.2f)}, area.to.x - margin) + em(0.8f);
    float widest = 0;
    for (const float tick : ticks(axes_.y)) widest = std::max(widest, ImGui::CalcTextSize(number(tick).c_str()).x);
    text(area.from.x + margin, y, colours_.muted, y_label());
    y += ImGui::GetTextLineHeight() + em(0.5f);
    const Area plot{{area.from.x + margin + widest + em(0.6f), y},
                    {area.to.x - margin, area.to.y - 2 * ImGui::GetTextLineHeight() - em(1.9f)}};
    const float label = ImGui::CalcTextSize(chart_.x_label.c_str()).x;
    text((plot.from.x + plot.to.x - label) / 2, area.to.y - ImGui::GetTextLineHeight() - em(0.7f), colours_.muted,
         chart_.x_label);
    return plot;
  }

  /// Breaks lines at `right`. Returns the y where the legend ends.
  float draw_legend(ImVec2 at, float right) {
    const float left = at.x, length = em(1.7f), line = ImGui::GetTextLineHeight();
    const auto entry = [&](const std::string& name, const auto& draw_sample) {
      if (name.empty()) return;
      const float width = length + em(0.5f) + ImGui::CalcTextSize(name.c_str()).x;
      if (at.x > left && at.x + width > right) at = {left, at.y + line + em(0.25f)};
      draw_sample(ImVec2(at.x, at.y + line / 2));
      text(at.x + length + em(0.5f), at.y, colours_.text, name);
      at.x += width + em(1.6f);
    };
    for (const ChartSeries& series : chart_.series)
      entry(series.name, [&](ImVec2 from) {
        if (series.mark != ChartMark::line) return draw_mark({from.x + length / 2, from.y}, series);
        list_.AddLine(from, {from.x + length, from.y}, series.colour, em(0.15f) * series.thickness);
      });
    if (chart_.band)
      entry(chart_.band->name, [&](ImVec2 from) {
        list_.AddRectFilled({from.x, from.y - em(0.4f)}, {from.x + length, from.y + em(0.4f)}, colours_.band);
      });
    return at.y + line;
  }

  /// The pixel of a point in axis coordinates.
  ImVec2 place(double x, double y) const {
    const double u = (x - axes_.x.low) / axes_.x.size(), v = (y - axes_.y.low) / axes_.y.size();
    return {plot_.from.x + static_cast<float>(u) * plot_.width(), plot_.to.y - static_cast<float>(v) * plot_.height()};
  }

  void draw_band() {
    if (!chart_.band) return;
    const double from = std::clamp(chart_.band->from, axes_.x.low, axes_.x.high);
    const double to = std::clamp(chart_.band->to, axes_.x.low, axes_.x.high);
    if (from < to) list_.AddRectFilled({place(from, 0).x, plot_.from.y}, {place(to, 0).x, plot_.to.y}, colours_.band);
  }

  void draw_ticks() {
    std::optional<UseFont> font;
    if (chart_.small) font.emplace(Font::small);
    const float line = ImGui::GetTextLineHeight();
    const std::vector<float> up = ticks(axes_.y), along = ticks(axes_.x);
    std::vector<float> ys, xs;
    for (const float tick : up) ys.push_back(std::round(place(axes_.x.low, tick).y) + 0.5f);
    for (const float tick : along) xs.push_back(std::round(place(tick, 0).x) + 0.5f);
    if (!chart_.small) {
      for (const float y : ys) list_.AddLine({plot_.from.x, y}, {plot_.to.x, y}, colours_.grid);
      for (const float x : xs) list_.AddLine({x, plot_.from.y}, {x, plot_.to.y}, colours_.grid);
    }
    const std::vector<std::string> heights = numbers(up), widths = numbers(along);
    std::vector<float> room;
    for (const std::string& label : widths) room.push_back(ImGui::CalcTextSize(label.c_str()).x);
    for (const std::size_t k :
         labelled_ticks(ys, std::vector<float>(ys.size(), line), chart_.small ? 0.6f * line : 0, shortest(heights)))
      text(plot_.from.x - em(0.35f) - ImGui::CalcTextSize(heights[k].c_str()).x, ys[k] - line / 2, colours_.muted,
           heights[k]);
    // Below the lowest number at the left, which ends half a line under the plot.
    for (const std::size_t k : labelled_ticks(xs, room, em(0.6f), shortest(widths)))
      text(xs[k] - room[k] / 2, plot_.to.y + em(chart_.small ? 0.4f : 0.5f), colours_.muted, widths[k]);
    const float zero = std::round(place(0, chart_.logarithmic ? axes_.y.low : 0).y) + 0.5f;
    list_.AddLine({plot_.from.x, zero}, {plot_.to.x, zero}, colours_.axis, chart_.small ? 1 : em(0.07f));
  }
  std::vector<std::string> numbers(const std::vector<float>& values) const {
    std::vector<std::string> texts;
    for (const float value : values) texts.push_back(number(value));
    return texts;
  }
  /// The roundest number, of which the label is to stay: 0, or 1 of 0.9, 1, 1.1.
  static std::size_t shortest(const std::vector<std::string>& labels) {
    const auto is_shorter = [](const std::string& a, const std::string& b) { return a.size() < b.size(); };
    return static_cast<std::size_t>(std::min_element(labels.begin(), labels.end(), is_shorter) - labels.begin());
  }

  /// Labels are inside the plot: of vertical lines at the top, each a line lower; of horizontal ones at the right.
  void draw_lines() {
    const UseFont font(Font::small);
    const float gap = em(0.3f), line = ImGui::GetTextLineHeight();
    for (const ChartLine& mark : chart_.vertical) {
      const float x = across(mark.at);
      list_.AddLine({x, plot_.from.y}, {x, plot_.to.y}, colours_.axis, em(0.08f));
    }
    for (const ChartLine& mark : chart_.horizontal) {
      const float y = up(mark.at);
      list_.AddLine({plot_.from.x, y}, {plot_.to.x, y}, colours_.axis, em(0.08f));
      name_line(mark.name, plot_.to.x - gap - ImGui::CalcTextSize(mark.name.c_str()).x, y - line - em(0.1f));
    }
    float y = plot_.from.y + gap;
    for (const ChartLine& mark : chart_.vertical) {
      name_line(mark.name, across(mark.at) + gap, y);
      y += line;
    }
  }
  float across(double x) const { return std::round(place(on_axis(x), 0).x) + 0.5f; }
  float up(double y) const { return std::round(place(0, on_axis(y)).y) + 0.5f; }
  /// A label with a background, to be readable over lines.
  void name_line(const std::string& name, float x, float y) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    list_.AddRectFilled({x, y}, {x + size.x, y + size.y}, colours_.paper);
    text(x, y, colours_.muted, name);
  }
  double on_axis(double value) const { return chart_.logarithmic ? std::log10(value) : value; }

  void draw_mark(ImVec2 at, const ChartSeries& series) {
    const float radius = em(0.28f);
    switch (series.mark) {
      case ChartMark::line:
        return;
      case ChartMark::dots:
        list_.AddCircleFilled(at, radius, series.colour, 20);
        return list_.AddCircle(at, radius, colours_.paper, 20, em(0.06f));
      case ChartMark::rings:
        list_.AddCircleFilled(at, radius, colours_.paper, 20);
        return list_.AddCircle(at, radius, series.colour, 20, em(0.12f));
      case ChartMark::crosses:
        list_.AddLine({at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}, series.colour, em(0.12f));
        list_.AddLine({at.x - radius, at.y + radius}, {at.x + radius, at.y - radius}, series.colour, em(0.12f));
    }
  }

  void draw_series(const ChartSeries& series) {
    std::vector<ImVec2> line;
    for (const ChartPoint& p : series.points) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      if (chart_.logarithmic && !(p.x > 0 && p.y > 0)) continue;
      const ImVec2 at =
          chart_.logarithmic ? place(std::log10(p.x), std::log10(p.y)) : place(p.x, p.y * axes_.prefix.factor);
      if (series.mark == ChartMark::line)
        line.push_back(at);
      else
        draw_mark(at, series);
    }
    list_.AddPolyline(line.data(), static_cast<int>(line.size()), series.colour, ImDrawFlags_None,
                      em(chart_.small ? 0.1f : 0.15f) * series.thickness);
  }

  ImDrawList& list_;
  const Chart& chart_;
  const ChartColours& colours_;
  Axes axes_;
  Area plot_{};
};

}  // namespace

const ChartColours light_chart = {colours::rgba(0xfcfbf9), colours::rgba(0x1d2527, 26), colours::rgba(0x8d9494),
                                  colours::rgba(0x1d2527), colours::rgba(0x5a6567),     colours::rgba(0xdfeeeb)};
ChartColours panel_chart() {
  return {colours::chart,
          (colours::faint & 0x00ffffff) | 0x3c000000,
          (colours::faint & 0x00ffffff) | 0x8c000000,
          colours::text,
          colours::faint,
          (colours::fill & 0x00ffffff) | 0x5a000000};
}

std::vector<std::size_t> labelled_ticks(std::span<const float> places, std::span<const float> sizes, float gap,
                                        std::size_t kept) {
  std::vector<std::size_t> chosen;
  for (std::size_t every = 1; every <= places.size(); ++every) {
    chosen.clear();
    bool has_room = true;
    for (std::size_t k = kept % every; k < places.size() && has_room; k += every) {
      if (!chosen.empty()) {
        const std::size_t before = chosen.back();
        has_room = std::abs(places[k] - places[before]) >= (sizes[k] + sizes[before]) / 2 + gap;
      }
      chosen.push_back(k);
    }
    if (has_room) break;
  }
  return chosen;
}

void draw_chart(ImDrawList& list, const Area& area, const Chart& chart, const ChartColours& colours) {
  Drawing(list, chart, colours).draw(area);
}

}  // namespace heml::panel
