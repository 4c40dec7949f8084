#pragma once
// A horizontal bar chart: one group of bars per line, with its label on the left and a value after each bar.
#include <app/panel/chart.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

struct BarChart {
  struct Group {
    std::string label;
    std::vector<double> values;  ///< one per entry of names
  };
  std::string title, subtitle;
  std::vector<std::string> names;  ///< of the bars of a group, for the legend
  std::vector<ImU32> colours;      ///< one per entry of names
  std::vector<Group> groups;
  std::optional<double> mark;  ///< value of a vertical line across all bars
};

/// Draws as draw_chart() does. Only finite values greater than 0 have a bar.
void draw_bars(ImDrawList& list, const Area& area, const BarChart& chart, const ChartColours& colours);

}  // namespace heml::panel
