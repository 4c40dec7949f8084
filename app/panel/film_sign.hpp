#pragma once
// The sign that a film is being made.
#include <app/panel/area.hpp>

namespace heml::panel {

/// "● Filming, 36 frames · V stops" in the upper right corner. Returns its lower edge, pixels.
float draw_film_sign(const Area& free, long frames);

}  // namespace heml::panel
