#pragma once
// The paper's degenerate case: springs along the edges of the mesh (elastic/springs.hpp). It has no energy W(F), so it
// is in laws() but not in LawList.
#include <heml/materials/law.hpp>

namespace heml {

struct MassSpring {
  static constexpr std::string_view name = "mass_spring";
  static constexpr std::string_view title = "Mass-spring net";
  static constexpr std::string_view formula = "Σ over mesh edges of k/2 (ℓ − L)²";
  static constexpr std::string_view source = "Goulette & Chendeb 2006, section 1: the degenerate case";
  static constexpr Parameter<MassSpring, double> parameters[] = {
      {nullptr, {"stiffness", "k", "N/m", "of the spring along every edge", ParameterRange::positive}},
  };
  static constexpr bool uses_I4 = false, has_volume_term = false, is_stress_free = true;
  static constexpr ForceCost cost = {17, 14};
  static constexpr SmallStrainModuli sample = {1e3, 5e4};
  /// For edges of 1 cm; Poisson's ratio cannot be chosen.
  static constexpr auto of_moduli(double shear, double) { return std::array{0.01 * shear}; }
};

}  // namespace heml
