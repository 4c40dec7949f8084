#pragma once
// The page that explains mouse and keys.
#include <app/panel/area.hpp>

namespace heml::panel {

/// Over the middle of the picture; false once the user closed it. `place`: where it was drawn.
bool draw_help(ImVec2 picture, Area& place);

}  // namespace heml::panel
