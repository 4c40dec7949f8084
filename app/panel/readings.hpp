#pragma once
// The sections with values and plots of body and engine: forces, energies, volume, errors, timing.
#include <app/panel/history.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

/// Draws the sections. Returns whether that of errors is open.
bool draw_readings(Rows& rows, const Frame& frame, const History& history);

}  // namespace heml::panel
