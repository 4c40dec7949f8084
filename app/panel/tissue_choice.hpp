#pragma once
// Choice of a tissue preset, and the source of the chosen one.
#include <app/panel/rows.hpp>
#include <heml/materials/material.hpp>
#include <heml/scenario/presets.hpp>

namespace heml::panel {

/// Draws the choice among presets() and the source of the current one. Returns true when another was chosen: the
/// material then has its law and parameters, but keeps its density, and its fibre direction if both laws have one.
bool choose_tissue(Rows& rows, Material& material);

/// Tissue, measurement, source and range of a preset, for a tooltip.
std::string tissue_hint(const Preset& preset);

}  // namespace heml::panel
