#pragma once
// The scale of the colour map, over the picture.
#include <app/panel/area.hpp>
#include <app/render/field_colours.hpp>

namespace heml::panel {

/// At the bottom of the free part of the picture; nothing for Field::none. Ratios begin at 0: only of tissue that is
/// turned inside out J is less, which is then said.
void draw_legend(Field field, const render::Range& range, const Area& free, bool turned_inside_out = false);

/// The part of a range that the legend shows.
render::Range legend_range(Field field, const render::Range& range, bool turned_inside_out);

}  // namespace heml::panel
