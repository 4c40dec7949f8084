#pragma once
// Sliders for the parameters of a law. Each function returns true when the user changed something.
#include <app/panel/rows.hpp>
#include <heml/materials/material.hpp>

namespace heml::panel {

/// One slider per parameter; parameter lists term by term, with buttons that add and remove a term. A parameter from a
/// mesh field shows the name of the field.
bool parameter_rows(Rows& rows, Material& material, const LawInfo& law);

/// Young's modulus and Poisson's ratio instead of λ and μ.
bool engineering_rows(Rows& rows, Material& material);

/// Direction of the fibres as two angles, degrees.
bool fibre_rows(Rows& rows, Material& material);

}  // namespace heml::panel
