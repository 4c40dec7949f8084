#include <doctest/doctest.h>

#include <app/panel/same_stiffness.hpp>
#include <array>
#include <cmath>

using namespace heml;
using namespace heml::panel;

namespace {

constexpr ParameterInfo mooney_parameters[] = {
    {"K1", "K1", "Pa", ""}, {"K2", "K2", "Pa", ""}, {"kappa", "κ", "Pa", ""}};
constexpr ParameterInfo iso_parameters[] = {{"K1", "K1", "Pa", ""}, {"kappa", "κ", "Pa", ""}};
constexpr ParameterInfo fung_parameters[] = {{"mu", "μ", "Pa", ""}, {"gamma", "γ", "", ""}, {"kappa", "κ", "Pa", ""}};
const LawInfo mooney{"mooney_rivlin", "", mooney_parameters, false}, iso{"neo_hookean_iso", "", iso_parameters, false},
    fung{"fung_demiray", "", fung_parameters, false};

// Energies as the laws' formulas give them, at simple shear by s (I1 = I2 = 3 + s², J = 1) and at a stretch s of all
// sides.
double neo_hookean_shear(const std::vector<double>& p, double s) { return p[1] / 2 * s * s; }
double mooney_shear(const std::vector<double>& p, double s) { return (p[0] + p[1]) * s * s; }
double fung_shear(const std::vector<double>& p, double s) { return p[0] / (2 * p[1]) * std::expm1(p[1] * s * s); }
double neo_hookean_swell(const std::vector<double>& p, double s) {
  const double J = s * s * s;
  return p[1] / 2 * (3 * s * s - 3) - p[1] * std::log(J) + p[0] / 2 * std::log(J) * std::log(J);
}
double kappa_swell(double kappa, double s) { return kappa / 2 * std::pow(s * s * s - 1, 2); }

}  // namespace

TEST_CASE("a law that replaces another stores the same energy under small strains") {
  const LawInfo* neo_hookean = find_law("neo_hookean");
  REQUIRE(neo_hookean);
  const Material before{"neo_hookean", {4e4, 5e3}, 1050};
  constexpr double s = 1e-4;
  const double shear = neo_hookean_shear(before.parameters, s), swell = neo_hookean_swell(before.parameters, 1 + s);

  const Material rivlin = same_stiffness(before, *neo_hookean, mooney);
  CHECK(rivlin.law == "mooney_rivlin");
  CHECK(rivlin.density == 1050);
  CHECK(mooney_shear(rivlin.parameters, s) == doctest::Approx(shear).epsilon(1e-6));
  CHECK(kappa_swell(rivlin.parameters[2], 1 + s) == doctest::Approx(swell).epsilon(1e-3));

  const Material demiray = same_stiffness(before, *neo_hookean, fung);
  CHECK(fung_shear(demiray.parameters, s) == doctest::Approx(shear).epsilon(1e-6));
  CHECK(kappa_swell(demiray.parameters[2], 1 + s) == doctest::Approx(swell).epsilon(1e-3));

  const Material back = same_stiffness(rivlin, mooney, *neo_hookean);
  CHECK(back.parameters[0] == doctest::Approx(4e4).epsilon(1e-12));
  CHECK(back.parameters[1] == doctest::Approx(5e3).epsilon(1e-12));
  const Material plain = same_stiffness(rivlin, mooney, iso);
  CHECK(plain.parameters[0] == doctest::Approx(2.5e3).epsilon(1e-12));
}

TEST_CASE("every law of this build can replace every other") {
  for (const LawInfo& from : laws())
    for (const LawInfo& to : laws()) {
      CAPTURE(from.name);
      CAPTURE(to.name);
      const LawInfo* neo_hookean = find_law("neo_hookean");
      REQUIRE(neo_hookean);
      const Material first = same_stiffness({"neo_hookean", {4e4, 5e3}, 1000}, *neo_hookean, from);
      CHECK_FALSE(material_problem(same_stiffness(first, from, to)));
    }
}
