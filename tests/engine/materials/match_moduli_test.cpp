#include <doctest/doctest.h>

#include <heml/materials/match_moduli.hpp>

namespace heml::match_moduli_test {

namespace {

Material soft_tissue() {
  Material material;
  material.law = "neo_hookean";
  material.parameters = {4e4, 5e3};
  material.density = 1050;
  return material;
}

Material replaced(const Material& material, std::string_view law) {
  return match_moduli(material, *find_law(material.law), *find_law(law));
}

}  // namespace

TEST_CASE("a law that replaces any other has the same shear and bulk modulus, and the same density") {
  for (const LawInfo& from : laws())
    for (const LawInfo& to : laws()) {
      if (!from.is_continuum || !to.is_continuum) continue;
      CAPTURE(from.name);
      CAPTURE(to.name);
      const Material first = replaced(soft_tissue(), from.name), second = replaced(first, to.name);
      REQUIRE_FALSE(material_problem(first));
      REQUIRE_FALSE(material_problem(second));
      CHECK(second.density == 1050);
      CHECK(small_strain_moduli(second).shear == doctest::Approx(5e3).epsilon(1e-9));
      CHECK(small_strain_moduli(second).bulk == doctest::Approx(4e4 + 2 * 5e3 / 3).epsilon(1e-9));
    }
}

TEST_CASE("parameters by formulas: two Lamé parameters, K1 and K2, an Ogden term") {
  CHECK(replaced(soft_tissue(), "stvk").parameters[0] == doctest::Approx(4e4).epsilon(1e-12));
  CHECK(replaced(soft_tissue(), "stvk").parameters[1] == doctest::Approx(5e3).epsilon(1e-12));
  CHECK(replaced(soft_tissue(), "neo_hookean_iso").parameters[0] == doctest::Approx(2.5e3).epsilon(1e-12));
  const auto mooney = replaced(soft_tissue(), "mooney_rivlin").parameters;
  CHECK(mooney[0] == doctest::Approx(2e3).epsilon(1e-12));
  CHECK(mooney[1] == doctest::Approx(5e2).epsilon(1e-12));
  const auto ogden = replaced(soft_tissue(), "ogden").parameters;
  REQUIRE(ogden.size() == 3);
  CHECK(ogden[0] * ogden[1] / 2 == doctest::Approx(5e3).epsilon(1e-12));
}

TEST_CASE("a net of springs is as stiff as springs of 1 cm") {
  const Material net = replaced(soft_tissue(), "mass_spring");
  REQUIRE_FALSE(material_problem(net));
  CHECK(net.parameters.front() == doctest::Approx(0.01 * engineering_constants({4e4, 5e3}).young));
  const Material back = replaced(net, "neo_hookean");
  const EngineeringConstants now = engineering_constants({back.parameters[0], back.parameters[1]});
  CHECK(now.young == doctest::Approx(engineering_constants({4e4, 5e3}).young));
  CHECK(now.poisson == doctest::Approx(0.25));
}

TEST_CASE("settings that the new law does not support are dropped") {
  Material material = replaced(soft_tissue(), "ogden");
  material.viscosity = 3;
  material.relaxation = {{0.5, 1}};
  material.volume_term = VolumeTerm::logarithmic;
  material.plasticity = Plasticity{1e3, 10};
  REQUIRE_FALSE(material_problem(material));
  const Material iso = replaced(material, "yeoh");
  CHECK(iso.viscosity == 3);
  CHECK(iso.relaxation.size() == 1);
  CHECK(iso.plasticity);
  CHECK(iso.volume_term == VolumeTerm::logarithmic);
  const Material fibres = replaced(material, "hgo");
  CHECK_FALSE(material_problem(fibres));
  CHECK(fibres.fibre == Vec3::UnitX());
  CHECK_FALSE(fibres.plasticity);
  const Material plain = replaced(material, "stvk");
  CHECK_FALSE(material_problem(plain));
  CHECK(plain.viscosity == 3);
  CHECK(plain.relaxation.empty());
  Material turned = fibres;
  turned.fibre = Vec3::UnitZ();
  CHECK(replaced(turned, "hgo").fibre == Vec3::UnitZ());
}

TEST_CASE("a field of fibres stays with every continuum law, a direction with those that need it") {
  Material muscle = replaced(soft_tissue(), "hgo");
  muscle.fibre = Vec3::Zero();
  muscle.fibre_field = "fibre";
  for (const LawInfo& law : laws()) {
    CAPTURE(law.name);
    const Material other = replaced(muscle, law.name);
    CHECK_FALSE(material_problem(other));
    CHECK(other.fibre_field == (law.is_continuum ? "fibre" : ""));
  }
  CHECK(replaced(replaced(soft_tissue(), "hgo"), "stvk").fibre == Vec3::Zero());
}

}  // namespace heml::match_moduli_test
