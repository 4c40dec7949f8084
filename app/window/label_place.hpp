#pragma once
// Where a label of a line of points stands: beside it, so that it covers none of them.
#include <app/panel/area.hpp>
#include <span>

namespace heml::window {

/// The upper left corner (pixels) for a label of a size beside the middle of the first two points, or else beside all
/// points: the first place within an area where it is `gap` off the points and off the lines between them. Where there
/// is none, above them, as far as the area goes.
ImVec2 place_beside(std::span<const ImVec2> points, ImVec2 size, const panel::Area& within, float gap);

}  // namespace heml::window
