#pragma once
// Curves over an axis with round numbers: the small one of the panel, and the large one of `heml bench-test`.
#include <app/panel/area.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

struct ChartPoint {
  double x, y;
};

enum class ChartMark { line, dots, rings, crosses };

struct ChartSeries {
  std::string name;  ///< in the legend; empty: not there
  std::vector<ChartPoint> points;
  ImU32 colour = 0;
  ChartMark mark = ChartMark::line;  ///< or points of their own
  float thickness = 1;               ///< of the line, relative
};

/// A line across the plot at one x or one y, with its name at its end.
struct ChartLine {
  double at;
  std::string name;
};

/// Part of the x axis that is marked behind the curves.
struct ChartBand {
  double from, to;
  std::string name;
};

struct Chart {
  std::string title, subtitle;      ///< empty: no room is taken
  std::string x_label, y_quantity;  ///< "Stretch λ"; "Nominal stress", to which the unit is added
  std::string y_unit;               ///< "Pa": shown with the prefix that suits
  std::vector<ChartSeries> series;
  std::optional<ChartBand> band;
  std::vector<ChartLine> upright, level;  ///< at an x; at a y. In a logarithmic chart their decade is shown too
  bool logarithmic = false;               ///< both axes: points that are not greater than 0 are left out
  bool small = false;                     ///< for the panel: fewer numbers, no grid, no legend
};

struct ChartColours {
  ImU32 paper, grid, axis, text, muted, band;
};
extern const ChartColours light_chart, dark_chart;

/// Into an area of the picture, with the fonts of the current ImGui context. Points that are not finite are left out.
void draw_chart(ImDrawList& list, const Area& area, const Chart& chart, const ChartColours& colours);

}  // namespace heml::panel
