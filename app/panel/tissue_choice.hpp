#pragma once
// Tissues with published numbers to choose from, and what is known of the chosen one.
#include <app/panel/rows.hpp>
#include <heml/materials/material.hpp>

namespace heml::panel {

/// A choice among presets(), and the source of the one the material has. True when another was chosen: the material
/// then has its law and parameters, its own density, and its own fibre where both have one.
bool choose_tissue(Rows& rows, Material& material);

}  // namespace heml::panel
