#pragma once
// Parameters for another law that make a tissue behave the same under small strains.
#include <heml/materials/material.hpp>

namespace heml::panel {

/// Moduli under small strains, Pa.
struct SmallStrain {
  double shear, bulk;
};

/// From parameters by their names in scene files. Names it does not know are left out of account.
SmallStrain small_strain(const LawInfo& law, const std::vector<double>& parameters);

/// The material with another law: the same density, shear and bulk modulus; exponents start moderate.
Material same_stiffness(const Material& material, const LawInfo& from, const LawInfo& to);

}  // namespace heml::panel
