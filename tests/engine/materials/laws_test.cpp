#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <heml/materials/law_list.hpp>
#include <heml/materials/parameter_slots.hpp>
#include <limits>

#include "every_law.hpp"

// Properties of every law, independent of its formula. The formulas are tested in closed_forms_test.cpp, the limits of
// laws in continuation_test.cpp.

namespace heml::laws_test {

using namespace heml::test;

namespace {

/// Calls check(material, continued) for every sample, continuation off and on.
template <class Check>
void for_every_law(const Check& check) {
  for (const Material& material : samples())
    for (const bool continued : {false, true}) {
      CAPTURE(material.law);
      CAPTURE(continued);
      check(material, continued);
    }
}

/// A random F: any orientation, stretches 0.1 to 5, in 2/8 of cases two and in 1/8 all three of them equal (exactly, or
/// to 1e-9), J in [0.05, 3], or in [−1, 3] for continued laws.
Mat3 random_state(std::mt19937_64& random, bool continued) {
  for (;;) {
    Vec3 stretches;
    for (double& s : stretches) s = std::exp(uniform(random, std::log(0.1), std::log(5.0)));
    const auto kind = random() % 8;
    const double apart = random() % 2 ? 1e-9 : 0;
    if (kind < 3) stretches[1] = stretches[0] * (1 + apart);
    if (kind == 0) stretches[2] = stretches[0] * (1 - apart);
    if (continued && random() % 2) stretches[0] *= -1;
    const double J = stretches.prod();
    if (J > 3 || J < (continued ? -1 : 0.05)) continue;
    return random_rotation(random) * stretches.asDiagonal() * random_rotation(random);
  }
}

/// Calls check(F) for those of 200 random states that are in the law's range: at least half, all for continued laws.
template <class Check>
void for_random_states(const MaterialPoint& point, bool continued, std::mt19937_64& random, const Check& check) {
  int outside = 0;
  for (int i = 0; i < 200; ++i) {
    const Mat3 F = random_state(random, continued);
    if (point.valid(F) && point.first_piola(F).norm() < 1e200)
      check(F);
    else
      ++outside;
  }
  CHECK(outside <= (continued ? 0 : 100));
}

/// Ī4 = J^(−2/3) a0·C a0; 0 without a fibre.
double fibre_stretch(const Material& material, const Mat3& F) {
  return (F * material.fibre).squaredNorm() / std::pow(std::abs(F.determinant()), 2.0 / 3);
}

}  // namespace

TEST_CASE(
    "stress is the gradient of the energy, and its differential that of the stress, inverted too when continued") {
  std::mt19937_64 random(5);
  for_every_law([&](const Material& material, bool continued) {
    const auto point = make_material_point(material, continued);
    for_random_states(*point, continued, random, [&](const Mat3& F) {
      CAPTURE(F);
      if (std::abs(fibre_stretch(material, F) - 1) < 1e-2) return;  // stiffness jumps where a fibre begins to bear load
      const Mat3 dF = random_direction(random), P = point->first_piola(F), dP = point->first_piola_differential(F, dF);
      if (!continued && P.norm() > 1e12) return;  // exponentials too steep for finite differences
      // Fourth-order differences, whose relative truncation error stays below 1e-8.
      const double h = 3e-4 * std::min(1.0, F.jacobiSvd().singularValues()[2]);
      const auto W = [&](double t) { return point->energy(F + t * dF); };
      const auto P_at = [&](double t) { return point->first_piola(F + t * dF); };
      const double slope = (8 * (W(h) - W(-h)) - (W(2 * h) - W(-2 * h))) / (12 * h);
      const Mat3 change = (8 * (P_at(h) - P_at(-h)) - (P_at(2 * h) - P_at(-2 * h))) / (12 * h);
      CHECK(std::abs(inner(P, dF) - slope) <= 1e-6 * (P.norm() + min_stress(material)));
      CHECK((dP - change).norm() <= 1e-5 * (dP.norm() + min_stress(material)));
    });
  });
}

TEST_CASE_TEMPLATE("laws with powers of J are defined down to one limit, and finite there", Real, float, double) {
  const auto check = [](const auto& law) {
    for (const bool is_flat : {false, true}) {  // volume is lost along one direction or along all
      const auto at = [&](Real J) {
        const Real a = is_flat ? J : std::cbrt(J), b = is_flat ? Real(1) : a;
        return Invariants<Real>{a * a + 2 * b * b, 2 * a * a * b * b + b * b * b * b, J};
      };
      const Invariants<Real> above = at(Real(1.001) * min_volume_ratio<Real>);
      CHECK(law.valid(above));
      CHECK_FALSE(law.valid(at(Real(0.999) * min_volume_ratio<Real>)));
      const auto first = law.first_derivatives(above);
      const auto second = law.second_derivatives(above);
      for (const Real value : {law.energy(above), first.w1, first.w2, first.wJ, second.w11, second.w12, second.w22,
                               second.w1J, second.w2J, second.wJJ})
        CHECK(std::isfinite(value));
    }
  };
  const Real modulus = 1e6;
  check(NeoHookean<Real, false>{modulus, modulus});
  check(NeoHookeanIso<Real, false>{{}, modulus, modulus});
  check(MooneyRivlin<Real, false>{{}, modulus, modulus, modulus});
  check(Yeoh<Real, false>{{}, modulus, modulus, modulus, modulus});
  check(VolumeLaw<Real, false, false>{modulus});
  check(VolumeLaw<Real, false, true>{modulus});
}

TEST_CASE("turning the body turns its stress and leaves its energy") {
  std::mt19937_64 random(6);
  for_every_law([&](const Material& material, bool continued) {
    const auto point = make_material_point(material, continued);
    for_random_states(*point, continued, random, [&](const Mat3& F) {
      const Mat3 Q = random_rotation(random), P = point->first_piola(F);
      CHECK(point->energy(Q * F) == doctest::Approx(point->energy(F)).epsilon(1e-11));
      CHECK((point->first_piola(Q * F) - Q * P).norm() <= 1e-11 * (P.norm() + min_stress(material)));
    });
  });
}

TEST_CASE("every law without fibres is isotropic") {
  std::mt19937_64 random(7);
  for_every_law([&](const Material& material, bool continued) {
    const auto point = make_material_point(material, continued);
    for_random_states(*point, continued, random, [&](const Mat3& F) {
      const Mat3 Q = random_rotation(random), P = point->first_piola(F);
      Material turned = material;
      turned.fibre = Q.transpose() * material.fibre;
      const auto other = make_material_point(turned, continued);
      CHECK(other->energy(F * Q) == doctest::Approx(point->energy(F)).epsilon(1e-11));
      CHECK((other->first_piola(F * Q) - P * Q).norm() <= 1e-11 * (P.norm() + min_stress(material)));
    });
  });
}

TEST_CASE("the stiffness is symmetric") {
  std::mt19937_64 random(8);
  for_every_law([&](const Material& material, bool continued) {
    const auto point = make_material_point(material, continued);
    for_random_states(*point, continued, random, [&](const Mat3& F) {
      const Mat3 A = random_direction(random), B = random_direction(random);
      const Mat3 dA = point->first_piola_differential(F, A), dB = point->first_piola_differential(F, B);
      CHECK(std::abs(inner(A, dB) - inner(B, dA)) <= 1e-11 * (dA.norm() + dB.norm()));
    });
  });
}

TEST_CASE("at rest there is neither energy nor stress, but for the laws as printed in the paper, which have stress") {
  for_every_law([](const Material& material, bool continued) {
    const auto point = make_material_point(material, continued);
    const double stress = point->first_piola(Mat3::Identity()).norm(), shear = small_strain_moduli(material).shear;
    CHECK(std::abs(point->energy(Mat3::Identity())) <= 1e-14 * shear);
    if (find_law(material.law)->is_stress_free)
      CHECK(stress <= 1e-13 * shear);
    else
      CHECK(stress > 0.1 * shear);
  });
}

TEST_CASE("for small strains every law is Hooke's with its constants at rest") {
  std::mt19937_64 random(9);
  for_every_law([&](const Material& material, bool continued) {
    if (!find_law(material.law)->is_stress_free) return;
    if (material.law == "guccione") return;  // its fibres bear compression too: Hooke's law of another symmetry
    const auto point = make_material_point(material, continued);
    const auto [mu, kappa] = small_strain_moduli(material);
    for (int i = 0; i < 20; ++i) {
      const double size = 1e-6;
      Mat3 strain = random_direction(random) * size;
      strain = (strain + strain.transpose()).eval() / 2;
      const Mat3 deviatoric_strain = strain - strain.trace() / 3 * Mat3::Identity();
      if (find_law(material.law)->has_fibre && askew.dot(deviatoric_strain * askew) > -size / 20)
        continue;  // only where fibres are compressed and bear no load
      const Mat3 stress = 2 * mu * deviatoric_strain + kappa * strain.trace() * Mat3::Identity();
      const Mat3 turn = random_rotation(random);
      CHECK((point->first_piola(turn * (Mat3::Identity() + strain)) - turn * stress).norm() <=
            20 * size * (mu + kappa) * size);
    }
  });
}

TEST_CASE("every law makes a material of given moduli") {
  for (const LawInfo& law : laws()) {
    if (!law.is_continuum || !law.is_stress_free) continue;
    CAPTURE(law.name);
    for (const SmallStrainModuli rest : {SmallStrainModuli{1e3, 5e4}, SmallStrainModuli{3e6, 4e6}}) {
      CHECK(small_strain_moduli(heml::sample_material(law, rest)).shear == doctest::Approx(rest.shear).epsilon(1e-12));
      CHECK(small_strain_moduli(heml::sample_material(law, rest)).bulk == doctest::Approx(rest.bulk).epsilon(1e-12));
    }
  }
}

TEST_CASE("a parameter outside its range is refused, and what a law begins with is in it") {
  for (const LawInfo& law : laws()) {
    CAPTURE(law.name);
    const Material sample = heml::sample_material(law);
    const auto slots = parameter_slots(sample, law);
    for (std::size_t i = 0; i < slots.size(); ++i) {
      const ParameterInfo& info = *slots[i].info;
      CAPTURE(info.name);
      const auto refused = [&](double value) {
        Material material = sample;
        material.parameters[i] = value;
        const auto problem = material_problem(material);
        return problem && problem->first == slots[i].key();
      };
      CHECK(refused(std::numeric_limits<double>::infinity()));
      CHECK_FALSE(refused(sample.parameters[i]));
      CHECK_FALSE(refused(info.initial_value));
      if (info.range == ParameterRange::positive) CHECK(refused(0));
      if (info.range == ParameterRange::positive || info.range == ParameterRange::not_negative) CHECK(refused(-1));
      if (info.range == ParameterRange::not_zero) CHECK(refused(0));
    }
  }
}

TEST_CASE("a problem of a material is named") {
  const auto key = [](std::string law, std::vector<double> parameters, double density = 1000) {
    Material material;
    material.law = std::move(law);
    material.parameters = std::move(parameters);
    material.density = density;
    const auto problem = material_problem(material);
    return problem ? problem->first : "";
  };
  CHECK(key("stvk", {1e4, 1e3}) == "");
  CHECK(key("stvk", {1e4, -1}) == "mu");
  CHECK(key("stvk", {-1e4, 1e3}) == "lambda");
  CHECK(key("stvk", {NAN, 1e3}) == "lambda");
  CHECK(key("stvk", {1e4, 1e3}, 0) == "density");
  CHECK(key("stvk", {1e4}) == "law");
  CHECK(key("rubber", {1e4, 1e3}) == "law");
  CHECK(key("ogden", {300, -200, 3, -4, 5e4}) == "");
  CHECK(key("ogden", {300, -200, 3, -4}) == "law");
  CHECK(key("ogden", {300, -200, 3, 0, 5e4}) == "alpha[1]");
  CHECK(key("mooney_rivlin", {400, 100, 0}) == "kappa");
  CHECK(key("mooney_rivlin", {400, -500, 5e4}) != "");
  CHECK(key("fung_demiray", {1e3, -1, 5e4}) == "gamma");
  CHECK(key("gent", {1e3, 0, 5e4}) == "Jm");
  CHECK(key("hgo", {500, 5e4, 800, 2}) == "fibre");
}

TEST_CASE("Young's modulus and Poisson's ratio become Lamé's and come back") {
  const LameParameters lame = lame_parameters(1e4, 0.45);
  CHECK(lame.mu == doctest::Approx(1e4 / 2.9).epsilon(1e-14));
  CHECK(lame.lambda + 2 * lame.mu / 3 == doctest::Approx(1e4 / 0.3).epsilon(1e-14));
  CHECK(engineering_constants(lame).young == doctest::Approx(1e4).epsilon(1e-14));
  CHECK(engineering_constants(lame).poisson == doctest::Approx(0.45).epsilon(1e-14));
}

}  // namespace heml::laws_test
