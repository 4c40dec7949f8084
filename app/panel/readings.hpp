#pragma once
// The sections with values and plots of body and engine: forces, energies, volume, errors, timing.
#include <app/panel/history.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

void draw_force(Rows& rows, const Frame& frame, const History& history);
void draw_energies(Rows& rows, const Frame& frame, const History& history);
void draw_volume(Rows& rows, const Frame& frame, const History& history);
void draw_errors(Rows& rows, const Frame& frame, const History& history);
void draw_engine(Rows& rows, const Frame& frame, const History& history);

}  // namespace heml::panel
