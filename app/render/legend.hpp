#pragma once
// What the colours mean: a bar with the field's name, unit and round numbers beside it.
#include <app/render/field_colours.hpp>
#include <app/render/image.hpp>

struct ImDrawList;

namespace heml::render {

/// Adds the legend to a draw list, at the top right of a picture of a size. Needs a current ImGui frame
/// (imgui_renderer.hpp). Does nothing for Field::none.
void draw_legend(ImDrawList& list, Field field, const Range& range, Size size);

}  // namespace heml::render
