#include <fmt/format.h>

#include <algorithm>
#include <heml/materials/parameter_slots.hpp>

namespace heml {

std::string ParameterSlot::key() const {
  return term < 0 ? std::string(info->name) : fmt::format("{}[{}]", info->name, term);
}

std::string ParameterSlot::symbol() const {
  const std::string_view shown = info->symbol.empty() ? info->name : info->symbol;
  return term < 0 ? std::string(shown) : fmt::format("{}{}", shown, term + 1);
}

std::vector<ParameterSlot> parameter_slots(const Material& material, const LawInfo& law) {
  const auto lists = std::count_if(law.parameters.begin(), law.parameters.end(),
                                   [](const ParameterInfo& info) { return info.is_list(); });
  const auto scalars = std::ssize(law.parameters) - lists;
  const auto length = lists ? (std::ssize(material.parameters) - scalars) / lists : 0;
  std::vector<ParameterSlot> slots;
  for (const ParameterInfo& info : law.parameters) {
    if (!info.is_list()) slots.push_back({&info, -1});
    for (int k = 0; info.is_list() && k < length; ++k) slots.push_back({&info, k});
  }
  return slots;
}

bool has_fixed_sign(const Material& material, std::size_t parameter) {
  Material opposite = material;
  opposite.parameters[parameter] *= -1;
  return material.parameters[parameter] != 0 && material_problem(opposite).has_value();
}

std::optional<std::size_t> volume_parameter(const Material& material, const LawInfo& law) {
  const std::string_view name = law.has_volume_term ? "kappa" : law.takes_young_poisson ? "lambda" : "";
  const std::vector<ParameterSlot> slots = parameter_slots(material, law);
  for (std::size_t i = 0; i < slots.size(); ++i)
    if (slots[i].info->name == name) return i;
  return std::nullopt;
}

}  // namespace heml
