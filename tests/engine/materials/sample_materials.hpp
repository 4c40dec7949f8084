#pragma once
// heml::sample_material() by the name of a law.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>
#include <string>

namespace heml::test {

/// The law of that name; fails the test if there is none.
inline const LawInfo& law_named(std::string_view law) {
  REQUIRE_MESSAGE(find_law(law), "no law ", std::string(law));
  return *find_law(law);
}
inline Material sample_material(std::string_view law) { return heml::sample_material(law_named(law)); }
inline Material sample_material(std::string_view law, double shear, double bulk) {
  return heml::sample_material(law_named(law), {shear, bulk});
}

}  // namespace heml::test
