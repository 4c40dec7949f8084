#pragma once
// Curves over the last seconds.
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
  std::string_view unit;  ///< of the values; of SI, or "", "%", "×", "mm", which take no prefix
  double base = 0;        ///< always within the plot
  double min_range = 0;   ///< of the vertical axis at least; keeps noise from filling the plot
  float height = 4.2f;    ///< em
};

/// As wide as there is room; the newest reading is at the right edge. Both ends of the axes are written with their
/// units. Says the values under the mouse.
void plot(const char* id, const History& history, std::span<const Curve> curves, const PlotStyle& style);

}  // namespace heml::panel
