#pragma once
// Line and scatter charts with round numbers on the axes: small for the panel, large for `heml bench-test` and the
// studies.
#include <app/panel/area.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace heml::panel {

struct ChartPoint {
  double x, y;
};

enum class ChartMark { line, dots, rings, crosses };

struct ChartSeries {
  std::string name;  ///< in the legend; empty: no entry
  std::vector<ChartPoint> points;
  ImU32 colour = 0;
  ChartMark mark = ChartMark::line;  ///< a line, or a mark per point
  float thickness = 1;               ///< of the line, relative
};

/// A line across the plot at a constant x or y, labelled at its end.
struct ChartLine {
  double at;
  std::string name;
};

/// An interval of the x axis, shaded behind the curves.
struct ChartBand {
  double from, to;
  std::string name;
};

struct Chart {
  std::string title, subtitle;      ///< empty: no room is taken
  std::string x_label, y_quantity;  ///< "Stretch λ"; "Nominal stress"; the unit is appended
  std::string y_unit;               ///< "Pa"; shown with an SI prefix
  std::vector<ChartSeries> series;
  std::optional<ChartBand> band;
  std::vector<ChartLine> vertical, horizontal;  ///< at constant x; at constant y. Logarithmic axes include them
  bool logarithmic = false;                     ///< both axes; points that are not positive are omitted
  bool small = false;                           ///< for the panel: fewer numbers, no grid, no legend
};

struct ChartColours {
  ImU32 paper, grid, axis, text, muted, band;
};
extern const ChartColours light_chart;  ///< of documents
ChartColours panel_chart();             ///< of the panel, in its theme

/// Which ticks of an axis have a label: every one, or else every second, third … one, so that the labels are at least
/// `gap` apart. places: of the ticks, evenly spaced; sizes: of their labels, along the axis. kept: a tick that has one
/// if any has.
std::vector<std::size_t> labelled_ticks(std::span<const float> places, std::span<const float> sizes, float gap,
                                        std::size_t kept);

/// Draws into an area of the image, with the fonts of the current ImGui context. Points that are not finite are
/// omitted.
void draw_chart(ImDrawList& list, const Area& area, const Chart& chart, const ChartColours& colours);

}  // namespace heml::panel
