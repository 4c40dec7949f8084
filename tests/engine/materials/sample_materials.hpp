#pragma once
// One soft material of every law.
#include <doctest/doctest.h>

#include <heml/materials/material.hpp>
#include <string>

namespace heml::test {

/// heml::sample_material() of a law by its name, of its own moduli or these (Pa). Fails for a law that is not there.
inline const LawInfo& law_named(std::string_view law) {
  REQUIRE_MESSAGE(find_law(law), "no law ", std::string(law));
  return *find_law(law);
}
inline Material sample_material(std::string_view law) { return heml::sample_material(law_named(law)); }
inline Material sample_material(std::string_view law, double shear, double bulk) {
  return heml::sample_material(law_named(law), {shear, bulk});
}

}  // namespace heml::test
