#pragma once
// The help page: mouse and keys.
#include <app/panel/area.hpp>

namespace heml::panel {

/// Draws the page in the middle of the image; returns false once the user closed it. `place`: set to its rectangle.
bool draw_help(ImVec2 picture, Area& place);

}  // namespace heml::panel
