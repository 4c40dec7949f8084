#pragma once
// One soft material of every law.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>
#include <map>
#include <string>

namespace heml::test {

/// Around 1 kPa, nearly incompressible where the law has a volume term, defined for stretches of 0.5 to 1.6. Fails for
/// a law it does not know.
inline Material sample_material(std::string_view law) {
  static const std::map<std::string, std::vector<double>, std::less<>> parameters = {
      {"stvk", {1.5e3, 1e3}},
      {"neo_hookean", {4e3, 1e3}},
      {"neo_hookean_iso", {500, 5e4}},
      {"mooney_rivlin", {400, 100, 5e4}},
      {"fung_demiray", {1e3, 1.5, 5e4}},
      {"ogden", {300, -200, 3, -4, 5e4}},
      {"hgo", {500, 5e4, 800, 2}},
      {"yeoh", {500, -50, 80, 5e4}},
      {"gent", {1e3, 20, 5e4}},
      {"veronda_westmann", {300, 3, 5e4}},
      {"stable_neo_hookean", {4e3, 1e3}},
      {"mass_spring", {10}},
      {"paper_neo_hookean", {500, 5e4}},
      {"paper_mooney_rivlin", {400, 100, 5e4}},
      {"paper_fung_demiray", {1e3, 1.5, 5e4}},
  };
  const auto found = parameters.find(law);
  REQUIRE_MESSAGE(found != parameters.end(), "no sample of the law ", std::string(law));
  Material material;
  material.law = law;
  material.parameters = found->second;
  if (find_law(law)->has_fibre) material.fibre = Vec3::UnitX();
  REQUIRE_FALSE(material_problem(material));
  return material;
}

}  // namespace heml::test
