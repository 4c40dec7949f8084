#pragma once
// The values of a material one by one: what each of Material::parameters is, lists taken apart.
#include <heml/materials/material.hpp>
#include <string>
#include <vector>

namespace heml {

/// What one entry of Material::parameters is.
struct ParameterSlot {
  const ParameterInfo* info;
  int term;  ///< of a list, from 0; −1: no list

  std::string key() const;     ///< as messages name it: "kappa", "mu[0]"
  std::string symbol() const;  ///< as the panel shows it: "κ", "μ1"
};

/// One per entry of material.parameters, which must have a length that suits the law.
std::vector<ParameterSlot> parameter_slots(const Material& material, const LawInfo& law);

/// Whether a value must keep its sign: material_problem() refuses the opposite one, all else left as it is.
bool has_fixed_sign(const Material& material, std::size_t parameter);

/// The index in Material::parameters of what keeps volume: the κ of a law with a volume term, the λ of one that takes
/// `young` and `poisson`; nothing for other laws.
std::optional<std::size_t> volume_parameter(const Material& material, const LawInfo& law);

}  // namespace heml
