#pragma once
// The legend of the colour map.
#include <app/panel/area.hpp>
#include <app/render/field_colours.hpp>

namespace heml::panel {

/// Draws the legend at the bottom of the free area; nothing for Field::none. Ratios start at 0; with inverted elements
/// the volume ratio may start below, and the title says so.
void draw_legend(Field field, const render::Range& range, const Area& free, bool inverted = false);

/// The part of a field's range that the legend shows.
render::Range legend_range(Field field, const render::Range& range, bool inverted);

}  // namespace heml::panel
