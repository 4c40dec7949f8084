#include <cmath>
#include <heml/materials/test_bench.hpp>

#include "sample_materials.hpp"

namespace heml::test_bench_test {

using heml::test::sample_material;

namespace {

constexpr BenchTest all_tests[] = {BenchTest::uniaxial, BenchTest::equibiaxial, BenchTest::planar, BenchTest::shear};

/// Laws that are stress-free at rest, so that tests begin at the rest shape.
bool starts_at_rest(const LawInfo& law) { return law.is_continuum && !law.name.starts_with("paper_"); }

std::string name_of(BenchTest test) { return std::string(bench_test_names()[static_cast<std::size_t>(test)]); }

template <class Check>
void for_every_law(const Check& check) {
  for (const LawInfo& law : laws()) {
    if (!law.is_continuum) continue;
    CAPTURE(law.name);
    check(law, *make_material_point(sample_material(law.name), false));
  }
}

}  // namespace

TEST_CASE("free faces bear no stress, and loaded ones are where the test puts them") {
  for_every_law([](const LawInfo&, const MaterialPoint& point) {
    for (const BenchTest test : all_tests) {
      CAPTURE(name_of(test));
      const bool shear = test == BenchTest::shear;
      const BenchCurve curve = run_bench(point, test, evenly_spaced(shear ? -0.5 : 0.8, shear ? 0.5 : 1.4, 13));
      REQUIRE(curve.points.size() == 13);
      for (const BenchPoint& at : curve.points) {
        CAPTURE(at.amount);
        const Mat3 P = point.first_piola(at.F);
        if (shear) {
          CHECK(at.F == Mat3(Mat3::Identity() + at.amount * Vec3::UnitX() * Vec3::UnitY().transpose()));
          CHECK(at.nominal == P(0, 1));
          continue;
        }
        CHECK(at.F(0, 0) == at.amount);
        CHECK(std::abs(P(2, 2)) < 1e-9 * 1e3);
        if (test == BenchTest::uniaxial) CHECK(std::abs(P(1, 1)) < 1e-9 * 1e3);
        if (test == BenchTest::equibiaxial) CHECK(at.F(1, 1) == at.amount);
        if (test == BenchTest::planar) CHECK(at.F(1, 1) == 1);
        CHECK(at.nominal == P(0, 0));
      }
    }
  });
}

// Free faces do no work, so the work of the loaded faces equals the change of the cube's energy.
TEST_CASE("nominal stress is the slope of the energy along the test") {
  for_every_law([](const LawInfo&, const MaterialPoint& point) {
    for (const BenchTest test : all_tests) {
      CAPTURE(name_of(test));
      const double h = 1e-4;
      for (const double amount : {0.85, 1.1, 1.35}) {
        CAPTURE(amount);
        const double amounts[] = {amount - 2 * h, amount - h, amount, amount + h, amount + 2 * h};
        const BenchCurve curve = run_bench(point, test, amounts);
        REQUIRE(curve.points.size() == 5);
        const auto W = [&](int k) { return point.energy(curve.points[static_cast<std::size_t>(k)].F); };
        const double slope = (8 * (W(3) - W(1)) - (W(4) - W(0))) / (12 * h);
        const Mat3 P = point.first_piola(curve.points[2].F);
        const double work = curve.points[2].nominal + (test == BenchTest::equibiaxial ? P(1, 1) : 0);
        CHECK(slope == doctest::Approx(work).epsilon(1e-6));
      }
    }
  });
}

TEST_CASE("small strains are Hooke's") {
  for_every_law([](const LawInfo& law, const MaterialPoint& point) {
    if (!starts_at_rest(law) || law.has_fibre) return;
    const auto [mu, kappa] = small_strain_moduli(sample_material(law.name));
    const double E = 9 * kappa * mu / (3 * kappa + mu), nu = (3 * kappa - 2 * mu) / (2 * (3 * kappa + mu));
    const double expected[] = {E, E / (1 - nu), E / (1 - nu * nu), mu};
    for (const BenchTest test : all_tests) {
      CAPTURE(name_of(test));
      const double rest = test == BenchTest::shear ? 0 : 1, h = 1e-5;
      const BenchCurve curve = run_bench(point, test, std::array{rest - h, rest + h});
      REQUIRE(curve.points.size() == 2);
      const double slope = (curve.points[1].nominal - curve.points[0].nominal) / (2 * h);
      CHECK(slope == doctest::Approx(expected[static_cast<int>(test)]).epsilon(1e-6));
    }
  });
}

// Incompressible neo-Hookean: nominal stress 2 K1 (λ − λ⁻²), 2 K1 (λ − λ⁻⁵), 2 K1 (λ − λ⁻³), 2 K1 γ.
TEST_CASE("a nearly incompressible neo-Hookean cube follows the textbook") {
  Material material = sample_material("neo_hookean_iso");
  const double K1 = material.parameters[0] = 500;
  material.parameters[1] = 5e10;
  const auto point = make_material_point(material, false);
  for (const double x : {0.6, 0.9, 1.5, 2.5}) {
    const double expected[] = {x - std::pow(x, -2), x - std::pow(x, -5), x - std::pow(x, -3), x};
    const double true_stress[] = {x * x - 1 / x, x * x - std::pow(x, -4), x * x - 1 / (x * x), x};
    for (const BenchTest test : all_tests) {
      CAPTURE(name_of(test));
      CAPTURE(x);
      const BenchCurve curve = run_bench(*point, test, std::array{x});
      REQUIRE(curve.points.size() == 1);
      CHECK(curve.points[0].nominal == doctest::Approx(2 * K1 * expected[static_cast<int>(test)]).epsilon(1e-6));
      CHECK(curve.points[0].cauchy == doctest::Approx(2 * K1 * true_stress[static_cast<int>(test)]).epsilon(1e-6));
    }
  }
}

// Compressible: λ (ln J) = μ (1 − λ_t²) fixes the free stretch λ_t, here by bisection.
TEST_CASE("a compressible neo-Hookean bar narrows as its law says") {
  const double lambda = 2e3, mu = 1e3;
  Material material;
  material.law = "neo_hookean";
  material.parameters = {lambda, mu};
  const auto point = make_material_point(material, false);
  for (const double x : {0.4, 0.8, 1.7, 3.0}) {
    double low = 0.1, high = 3;
    for (int k = 0; k < 200; ++k) {
      const double middle = (low + high) / 2;
      (mu * (middle * middle - 1) + lambda * std::log(x * middle * middle) > 0 ? high : low) = middle;
    }
    const double J = x * low * low;
    const BenchCurve curve = run_bench(*point, BenchTest::uniaxial, std::array{x});
    REQUIRE(curve.points.size() == 1);
    CHECK(curve.points[0].F(1, 1) == doctest::Approx(low).epsilon(1e-12));
    CHECK(curve.points[0].F(2, 2) == doctest::Approx(low).epsilon(1e-12));
    CHECK(curve.points[0].nominal == doctest::Approx(mu * (x - 1 / x) + lambda * std::log(J) / x).epsilon(1e-11));
  }
}

TEST_CASE("fibres stiffen a pull along them, not one across, and hold back their own direction") {
  Material along = sample_material("hgo"), across = along;
  across.fibre = Vec3::UnitY();
  const auto at = [](const Material& material, double stretch) {
    return run_bench(*make_material_point(material, false), BenchTest::uniaxial, std::array{stretch}).points.at(0);
  };
  Material matrix = sample_material("neo_hookean_iso");
  CHECK(at(along, 1.3).nominal > 2 * at(matrix, 1.3).nominal);
  CHECK(at(across, 1.3).nominal == doctest::Approx(at(matrix, 1.3).nominal).epsilon(1e-9));
  CHECK(at(across, 0.7).F(1, 1) < 0.99 * at(across, 0.7).F(2, 2));
}

TEST_CASE("the curve ends where the law does, on either side") {
  Material material = sample_material("gent");  // locks where Ī1 − 3 = γ² = Jm
  material.parameters = {1e3, 1, 5e6};
  const BenchCurve curve =
      run_bench(*make_material_point(material, false), BenchTest::shear, evenly_spaced(-2, 1.5, 36));
  REQUIRE(curve.points.size() + curve.unreached.size() == 36);
  CHECK(curve.points.front().amount == doctest::Approx(-0.9));
  CHECK(curve.points.back().amount == doctest::Approx(0.9));
  CHECK(curve.unreached.front() == -2);
  CHECK(curve.unreached.back() == 1.5);
  for (std::size_t k = 1; k < curve.points.size(); ++k) CHECK(curve.points[k].nominal > curve.points[k - 1].nominal);

  // λ_t² = 1 − 2λ/(λ + 2μ) (x² − 1) of Saint Venant and Kirchhoff is 0 at x = 1.3229: the cube is flat.
  const Material flat = [] {
    Material m = sample_material("stvk");
    m.parameters = {4e3, 1e3};
    return m;
  }();
  CHECK(run_bench(*make_material_point(flat, false), BenchTest::equibiaxial, std::array{1.32}).unreached.empty());
  CHECK(run_bench(*make_material_point(flat, false), BenchTest::equibiaxial, std::array{1.33}).points.empty());
}

TEST_CASE("a point of a curve does not depend on the other amounts or their order") {
  for_every_law([](const LawInfo&, const MaterialPoint& point) {
    const BenchCurve alone = run_bench(point, BenchTest::uniaxial, std::array{1.6});
    const BenchCurve among = run_bench(point, BenchTest::uniaxial, std::array{1.6, 1.2, 0.9, 1.4});
    REQUIRE(alone.points.size() == 1);
    REQUIRE(among.points.size() == 4);
    CHECK(among.points[0].amount == 0.9);
    CHECK(alone.points[0].nominal == doctest::Approx(among.points[3].nominal).epsilon(1e-10));
  });
}

TEST_CASE("other volume terms keep the same small strains and differ at large ones") {
  Material material = sample_material("neo_hookean_iso");
  material.parameters = {500, 2e3};
  const auto nominal = [&](VolumeTerm term, double stretch) {
    material.volume_term = term;
    return run_bench(*make_material_point(material, false), BenchTest::equibiaxial, std::array{stretch})
        .points.at(0)
        .nominal;
  };
  for (const VolumeTerm term : {VolumeTerm::logarithmic, VolumeTerm::simo_taylor}) {
    CHECK(nominal(term, 1.0001) == doctest::Approx(nominal(VolumeTerm::quadratic, 1.0001)).epsilon(1e-3));
    CHECK(std::abs(nominal(term, 1.5) / nominal(VolumeTerm::quadratic, 1.5) - 1) > 1e-3);
  }
}

TEST_CASE("stress relaxes from 1 + Σγ to 1") {
  const PronyTerm terms[] = {{0.5, 0.1}, {0.25, 10}};
  CHECK(relaxation_factor(terms, 0) == 1.75);
  CHECK(relaxation_factor(terms, 0.1) == doctest::Approx(1 + 0.5 / std::exp(1) + 0.25 * std::exp(-0.01)));
  CHECK(relaxation_factor(terms, 1e4) == doctest::Approx(1));
  CHECK(relaxation_factor({}, 3) == 1);
}

}  // namespace heml::test_bench_test
