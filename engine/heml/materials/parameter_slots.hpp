#pragma once
// Which parameter, and which term of a list, each entry of Material::parameters is.
#include <heml/materials/material.hpp>
#include <string>
#include <vector>

namespace heml {

/// The parameter and list term of one entry of Material::parameters.
struct ParameterSlot {
  const ParameterInfo* info;
  int term;  ///< index in a list; −1: the parameter is no list

  std::string key() const;     ///< for messages: "kappa", "mu[0]"
  std::string symbol() const;  ///< for the panel: "κ", "μ1"
};

/// One slot per entry of material.parameters, whose length must be valid for the law.
std::vector<ParameterSlot> parameter_slots(const Material& material, const LawInfo& law);

/// Whether a value must keep its sign: material_problem() rejects the material with that value negated.
bool has_fixed_sign(const Material& material, std::size_t parameter);

/// Index in Material::parameters of the modulus that resists change of volume: κ of a law with a volume term, λ of one
/// that takes `young` and `poisson`; nothing for other laws.
std::optional<std::size_t> volume_parameter(const Material& material, const LawInfo& law);

}  // namespace heml
