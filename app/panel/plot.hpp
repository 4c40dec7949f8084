#pragma once
// Plots of History over the last seconds.
#include <app/panel/history.hpp>
#include <app/panel/theme.hpp>
#include <span>
#include <string_view>

namespace heml::panel {

struct Curve {
  const char* name;
  ImU32 colour;
  double (*value)(const Reading&);
};

struct PlotStyle {
  std::string_view unit;  ///< of the values: SI, or "", "%", "×", "mm", "°", which take no prefix
  double base = 0;        ///< a value that is always within the plot
  double min_range = 0;   ///< of the vertical axis; keeps noise from filling the plot
  float height = 4.7f;    ///< em
};

/// Draws a plot over the available width; the newest reading is at the right edge. Both ends of the axes have labels
/// with units, beside the curves; a tooltip shows the values under the mouse.
void plot(const char* id, const History& history, std::span<const Curve> curves, const PlotStyle& style);

}  // namespace heml::panel
