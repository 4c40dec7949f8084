#pragma once
// Bars in groups, lying: one group a line, with its name before and its numbers behind the bars.
#include <app/panel/chart.hpp>
#include <optional>
#include <string>
#include <vector>

namespace heml::panel {

struct BarChart {
  struct Group {
    std::string label;
    std::vector<double> values;  ///< one a name
  };
  std::string title, subtitle;
  std::vector<std::string> names;  ///< of the bars of a group, in the legend
  std::vector<ImU32> colours;      ///< one a name
  std::vector<Group> groups;
  std::optional<double> mark;  ///< a line across all bars
};

/// As draw_chart(). Values that are not finite or negative have no bar.
void draw_bars(ImDrawList& list, const Area& area, const BarChart& chart, const ChartColours& colours);

}  // namespace heml::panel
