#pragma once
// The panel's section "Measure": the numbers of a Measure and their history.
#include <app/panel/actions.hpp>
#include <app/panel/history.hpp>
#include <app/panel/measure.hpp>
#include <app/panel/rows.hpp>

namespace heml::panel {

void draw_measure(Rows& rows, Measure& measure, const History& history, PanelActions& out);

/// What is written beside the line: "12.3 mm, 45.6°".
std::string measured_text(const Measured& measured);

}  // namespace heml::panel
