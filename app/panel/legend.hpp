#pragma once
// The scale of the colour map, over the picture.
#include <app/panel/area.hpp>
#include <app/render/field_colours.hpp>

namespace heml::panel {

/// At the bottom of the free part of the picture; nothing for Field::none.
void draw_legend(Field field, const render::Range& range, const Area& free);

}  // namespace heml::panel
