#include <heml/materials/parameter_slots.hpp>

#include "sample_materials.hpp"

namespace heml::parameter_slots_test {

using heml::test::sample_material;

TEST_CASE("list parameters get one slot per term, scalars one") {
  const Material ogden = sample_material("ogden");
  const auto slots = parameter_slots(ogden, *find_law("ogden"));
  REQUIRE(slots.size() == ogden.parameters.size());
  std::string keys, symbols;
  for (const ParameterSlot& slot : slots) {
    keys += slot.key() + ' ';
    symbols += slot.symbol() + ' ';
  }
  CHECK(keys == "mu[0] mu[1] alpha[0] alpha[1] kappa ");
  CHECK(symbols == "μ1 μ2 α1 α2 κ ");
}

TEST_CASE("every law has as many slots as parameters, and knows what keeps its volume") {
  for (const LawInfo& law : laws()) {
    CAPTURE(law.name);
    const Material material = sample_material(law.name);
    CHECK(parameter_slots(material, law).size() == material.parameters.size());
    const auto volume = volume_parameter(material, law);
    if (!law.is_continuum) {
      CHECK_FALSE(volume);
      continue;
    }
    REQUIRE(volume);
    Material stiffer = material;
    stiffer.parameters[*volume] *= 2;
    CHECK(small_strain_moduli(stiffer).bulk > 1.2 * small_strain_moduli(material).bulk);
    CHECK(small_strain_moduli(stiffer).shear == doctest::Approx(small_strain_moduli(material).shear));
  }
}

}  // namespace heml::parameter_slots_test
