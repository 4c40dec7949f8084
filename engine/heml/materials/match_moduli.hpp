#pragma once
// Parameters for another law that make a tissue behave the same under small strains.
#include <heml/materials/material.hpp>

namespace heml {

/// The material with another law: the same density, shear and bulk modulus at rest (small_strain_moduli()); exponents
/// and powers start moderate, and a fibre along x where the law needs one and there was none. What the law cannot have
/// beside it (relaxation, plasticity, a volume term, fields of the mesh) is dropped. A net of springs has no modulus of
/// its own: it is taken as 1 cm long springs, Young's modulus times that length, with Poisson's ratio 1/4.
Material match_moduli(const Material& material, const LawInfo& from, const LawInfo& to);

}  // namespace heml
