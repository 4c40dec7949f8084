#pragma once
// Converts a material to another law with the same behaviour under small strains.
#include <heml/materials/material.hpp>

namespace heml {

/// The material with the law `to`, the same density, and the same shear and bulk modulus at rest
/// (small_strain_moduli()). Exponents and powers take ParameterInfo::initial_value; a fibre that the law needs and the
/// material lacks is along x; a field of fibres stays with continuum laws that do not need it. Drops parameters from
/// mesh fields, and relaxation, plasticity and a volume term that the law cannot have. mass_spring has no modulus: its
/// stiffness is taken as Young's modulus times 1 cm, Poisson's ratio as 1/4.
Material match_moduli(const Material& material, const LawInfo& from, const LawInfo& to);

}  // namespace heml
