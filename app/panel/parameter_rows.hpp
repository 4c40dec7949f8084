#pragma once
// Sliders for the numbers of a law. Each returns true when the user changed something.
#include <app/panel/rows.hpp>
#include <heml/materials/material.hpp>

namespace heml::panel {

/// One slider a number, lists term by term with buttons that add and remove a term. What comes from a field of the mesh
/// is named instead.
bool parameter_rows(Rows& rows, Material& material, const LawInfo& law);

/// Young's modulus and Poisson's ratio instead of λ and μ.
bool engineering_rows(Rows& rows, Material& material);

/// Direction of the fibres as two angles.
bool fibre_rows(Rows& rows, Material& material);

}  // namespace heml::panel
