#include <fmt/format.h>

#include <cmath>
#include <heml/materials/laws.hpp>
#include <heml/materials/material.hpp>

namespace heml {
namespace {

template <class Tag>
LawInfo info_of(Tag) {
  using L = typename Tag::template Law<double, false>;
  const bool lame = std::size(L::parameters) == 2 && L::parameters[0].name == "lambda" && L::parameters[1].name == "mu";
  return {L::name, L::title, L::parameters, lame};
}

const auto& law_table() {
  static const auto table = std::apply([](auto... tag) { return std::array{info_of(tag)...}; }, LawList{});
  return table;
}

}  // namespace

std::span<const LawInfo> laws() { return law_table(); }

const LawInfo* find_law(std::string_view name) {
  for (const LawInfo& law : laws())
    if (law.name == name) return &law;
  return nullptr;
}

std::optional<std::pair<std::string, std::string>> material_problem(const Material& material) {
  using Problem = std::pair<std::string, std::string>;
  const LawInfo* law = find_law(material.law);
  if (!law) return Problem{"law", fmt::format("'{}' is not a law of this build", material.law)};
  if (material.parameters.size() != law->parameters.size())
    return Problem{"law", fmt::format("'{}' takes {} parameters, got {}", law->name, law->parameters.size(),
                                      material.parameters.size())};
  for (std::size_t i = 0; i < law->parameters.size(); ++i)
    if (!std::isfinite(material.parameters[i]))
      return Problem{law->parameters[i].name, fmt::format("must be finite, is {}", material.parameters[i])};
  if (law->takes_young_poisson) {
    const double lambda = material.parameters[0], mu = material.parameters[1];
    if (!(mu > 0)) return Problem{"mu", fmt::format("must be greater than 0 Pa, is {}", mu)};
    if (!(3 * lambda + 2 * mu > 0))
      return Problem{"lambda", fmt::format("must be greater than -2/3 mu ({} Pa), is {}", -2 * mu / 3, lambda)};
  }
  if (!(material.density > 0) || !std::isfinite(material.density))
    return Problem{"density", fmt::format("must be greater than 0 kg/m³, is {}", material.density)};
  return std::nullopt;
}

Lame lame_from(double young, double poisson) {
  return {young * poisson / ((1 + poisson) * (1 - 2 * poisson)), young / (2 * (1 + poisson))};
}

Engineering engineering_from(const Lame& lame) {
  return {lame.mu * (3 * lame.lambda + 2 * lame.mu) / (lame.lambda + lame.mu),
          lame.lambda / (2 * (lame.lambda + lame.mu))};
}

}  // namespace heml
