#pragma once
// Shared by tests that run for every law.
#include <heml/materials/point.hpp>

#include "sample_materials.hpp"
#include "support.hpp"

namespace heml::test {

inline const Vec3 askew = Vec3(2, -1, 2) / 3;

/// A sample material of every law W(F), with oblique fibres, and one of each non-default volume term.
inline std::vector<Material> samples() {
  std::vector<Material> list;
  for (const LawInfo& law : laws()) {
    if (!law.is_continuum) continue;
    list.push_back(sample_material(law.name));
    if (law.has_fibre) list.back().fibre = askew;
  }
  for (const VolumeTerm term : {VolumeTerm::logarithmic, VolumeTerm::simo_taylor}) {
    list.push_back(sample_material("mooney_rivlin"));
    list.back().volume_term = term;
  }
  return list;
}

/// A random dF of norm 1.
inline Mat3 random_direction(std::mt19937_64& random) {
  Mat3 dF;
  for (double& d : dF.reshaped()) d = uniform(random, -1, 1);
  return dF / dF.norm();
}

inline double inner(const Mat3& A, const Mat3& B) { return A.cwiseProduct(B).sum(); }

/// Lower bound, Pa, for the stress that errors are relative to.
inline double min_stress(const Material& material) {
  const auto [shear, bulk] = small_strain_moduli(material);
  return 1e-3 * (shear + bulk);
}

}  // namespace heml::test
