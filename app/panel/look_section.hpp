#pragma once
// The panel's section "Window": how the panel looks.
#include <app/panel/preferences.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

void draw_look(Rows& rows, Look& look);

}  // namespace heml::panel
