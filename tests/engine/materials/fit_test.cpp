#include <cmath>
#include <heml/materials/fit.hpp>
#include <support.hpp>

#include "sample_materials.hpp"

namespace heml::fit_test {

using heml::test::sample_material;

namespace {

MeasuredCurve measured(const Material& truth, const MeasuredTest& test, std::vector<double> amounts) {
  const auto stress = nominal_stresses(truth, test, amounts);
  REQUIRE(stress);
  return {std::move(amounts), *stress};
}

const FittedParameter& parameter(const FitResult& fit, const std::string& name) {
  for (const FittedParameter& p : fit.parameters)
    if (p.name == name) return p;
  FAIL("no parameter ", name);
  return fit.parameters.front();
}

}  // namespace

TEST_CASE("a curve made with known parameters gives them back, from another start") {
  for (const LawInfo& info : laws()) {
    if (!info.is_continuum || info.is_principal) continue;
    const std::string law(info.name);
    CAPTURE(law);
    Material truth = sample_material(law);
    if (law == "guccione") truth.fibre = Vec3(1, 1, 0).normalized();  // else its shear has no influence
    const MeasuredCurve data = measured(truth, BenchTest::uniaxial, evenly_spaced(0.7, 1.6, 19));
    Material start = truth;
    const bool lame = find_law(law)->takes_young_poisson;
    for (std::size_t i = 0; i < start.parameters.size(); ++i)
      if (find_law(law)->parameters[i].name != (lame ? "lambda" : "kappa")) start.parameters[i] *= i % 2 ? 0.7 : 1.4;
    REQUIRE(fit_problem(start, BenchTest::uniaxial, data, {}) == "");
    const FitResult fit = fit_material(start, BenchTest::uniaxial, data, {});
    CHECK(fit.converged);
    for (std::size_t i = 0; i < truth.parameters.size(); ++i)
      CHECK(fit.material.parameters[i] == doctest::Approx(truth.parameters[i]).epsilon(1e-6));
    CHECK(fit.rms < 1e-4);
    CHECK(fit.r_squared == doctest::Approx(1));
    for (const FittedParameter& p : fit.parameters) CHECK(p.determined);
  }
}

TEST_CASE("a fit of one Ogden term keeps the sign of its power and converges from far away") {
  Material truth = sample_material("ogden");
  truth.parameters = {-70, -19, 1e5};  // μ, α, κ
  Material start = truth;
  start.parameters = {-300, -5, 1e5};
  const FitResult fit =
      fit_material(start, BenchTest::uniaxial, measured(truth, BenchTest::uniaxial, evenly_spaced(0.8, 1.2, 21)), {});
  CHECK(fit.material.parameters[0] == doctest::Approx(-70).epsilon(1e-6));
  CHECK(fit.material.parameters[1] == doctest::Approx(-19).epsilon(1e-6));
  CHECK(fit.material.parameters[2] == 1e5);
}

TEST_CASE("the bulk modulus is fitted only on request and if the test depends on it") {
  Material truth = sample_material("neo_hookean_iso");
  truth.parameters = {500, 3e3};
  const MeasuredCurve data = measured(truth, BenchTest::equibiaxial, evenly_spaced(0.8, 1.6, 15));
  Material start = truth;
  start.parameters = {700, 2e3};
  CHECK(fit_material(start, BenchTest::equibiaxial, data, {}).material.parameters[1] == 2e3);
  const FitResult all = fit_material(start, BenchTest::equibiaxial, data, {.fit_volume = true});
  CHECK(all.material.parameters[0] == doctest::Approx(500).epsilon(1e-6));
  CHECK(all.material.parameters[1] == doctest::Approx(3e3).epsilon(1e-5));
}

// The stress is linear in K1, so ordinary least squares gives value, error and R² in closed form.
TEST_CASE("errors and R² are those of ordinary least squares where the law is linear in its parameter") {
  Material truth = sample_material("neo_hookean_iso");
  truth.parameters = {500, 5e4};
  const std::vector<double> gamma = evenly_spaced(0.05, 0.6, 12);
  MeasuredCurve data = measured(truth, BenchTest::shear, gamma);
  std::mt19937_64 random(7);
  for (double& stress : data.stress) stress += heml::test::uniform(random, -30, 30);
  double xx = 0, xy = 0, mean = 0;
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    xx += 4 * gamma[i] * gamma[i];  // P12 = 2 K1 γ
    xy += 2 * gamma[i] * data.stress[i];
    mean += data.stress[i] / 12;
  }
  const double K1 = xy / xx;
  double rest = 0, spread = 0;
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    rest += std::pow(data.stress[i] - 2 * K1 * gamma[i], 2);
    spread += std::pow(data.stress[i] - mean, 2);
  }
  const FitResult fit = fit_material(truth, BenchTest::shear, data, {});
  CHECK(parameter(fit, "K1").value == doctest::Approx(K1).epsilon(1e-7));
  CHECK(parameter(fit, "K1").standard_error == doctest::Approx(std::sqrt(rest / 11 / xx)).epsilon(1e-5));
  CHECK(fit.rms == doctest::Approx(std::sqrt(rest / 12)).epsilon(1e-7));
  CHECK(fit.r_squared == doctest::Approx(1 - rest / spread).epsilon(1e-7));
}

TEST_CASE("a parameter without influence is left and named, and the others are found") {
  const Material truth = sample_material("guccione");  // pulled along its fibre, without shear
  Material start = truth;
  start.parameters = {1400, 5.6, 2.8, 3, truth.parameters[4]};
  const FitResult fit =
      fit_material(start, BenchTest::uniaxial, measured(truth, BenchTest::uniaxial, evenly_spaced(0.7, 1.6, 19)), {});
  CHECK(fit.converged);
  for (const std::size_t i : {0, 1, 2})
    CHECK(fit.material.parameters[i] == doctest::Approx(truth.parameters[i]).epsilon(1e-5));
  CHECK(fit.material.parameters[3] == doctest::Approx(3).epsilon(1e-12));
  CHECK_FALSE(parameter(fit, "bfs").determined);
}

TEST_CASE("a fit names the parameters that the data do not determine") {
  // The stress in simple shear depends on K1 + K2 alone.
  const Material truth = sample_material("mooney_rivlin");
  const MeasuredCurve shear = measured(truth, BenchTest::shear, evenly_spaced(-0.4, 0.4, 9));
  const FitResult fit = fit_material(truth, BenchTest::shear, shear, {});
  CHECK_FALSE(parameter(fit, "K1").determined);
  CHECK_FALSE(parameter(fit, "K2").determined);
  CHECK(std::isinf(parameter(fit, "K1").standard_error));
  // Uniaxial tension determines both.
  const FitResult pull =
      fit_material(truth, BenchTest::uniaxial, measured(truth, BenchTest::uniaxial, evenly_spaced(0.7, 1.5, 9)), {});
  CHECK(parameter(pull, "K1").determined);
  CHECK(parameter(pull, "K2").determined);
  // A curve that is straight to within noise does not determine the stiffening γ.
  Material fung = sample_material("fung_demiray");
  MeasuredCurve nearly = measured(fung, BenchTest::uniaxial, evenly_spaced(0.99, 1.01, 9));
  std::mt19937_64 random(3);
  for (double& stress : nearly.stress) stress += heml::test::uniform(random, -3, 3);
  const FitResult flat = fit_material(fung, BenchTest::uniaxial, nearly, {});
  CHECK(parameter(flat, "mu").determined);
  CHECK_FALSE(parameter(flat, "gamma").determined);
}

TEST_CASE("relaxation gives γ, τ and one factor of the moduli back") {
  Material truth = sample_material("ogden");
  truth.relaxation = {{0.8, 0.5}, {0.4, 20}};
  const MeasuredTest test = Relaxation{1.15};
  std::vector<double> times;
  for (int k = 0; k <= 60; ++k) times.push_back(0.01 * std::pow(10, k / 15.0));
  MeasuredCurve data = measured(truth, test, times);
  Material start = truth;
  start.relaxation = {{0.5, 0.2}, {0.5, 50}};
  for (std::size_t i : {0, 1}) start.parameters[i] *= 0.5;
  const FitResult fit = fit_material(start, test, data, {});
  REQUIRE(fit.material.relaxation.size() == 2);
  CHECK(fit.material.relaxation[0].gamma == doctest::Approx(0.8).epsilon(1e-5));
  CHECK(fit.material.relaxation[0].tau == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(fit.material.relaxation[1].gamma == doctest::Approx(0.4).epsilon(1e-5));
  CHECK(fit.material.relaxation[1].tau == doctest::Approx(20).epsilon(1e-5));
  CHECK(fit.material.parameters[4] == truth.parameters[4]);
  CHECK(fit.rms < 1e-3);
}

TEST_CASE("refuses what cannot be fitted") {
  const Material material = sample_material("yeoh");
  CHECK(fit_problem(material, BenchTest::uniaxial, {{1.1, 1.2}, {10, 20}}, {}).find("2 measured points") == 0);
  CHECK(fit_problem(material, Relaxation{}, {{0, 1, 2, 3}, {4, 3, 2, 2}}, {}).find("relaxation") != std::string::npos);
  Material gent = sample_material("gent");
  gent.parameters[1] = 0.5;
  CHECK(fit_problem(gent, BenchTest::uniaxial, {{1.1, 1.5, 3}, {10, 20, 30}}, {}).find("range") != std::string::npos);
}

}  // namespace heml::fit_test
