#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/continuum.hpp>
#include <heml/materials/laws.hpp>

#include "support.hpp"

using namespace heml;
using test::random_gradient;

namespace {

constexpr double lambda = 3.1e4, mu = 3.4e3;

/// The energies as the contract writes them, from E and ln det F, in more digits than double has.
using Long3 = Eigen::Matrix<long double, 3, 3>;
long double written(std::string_view law, const Mat3& F) {
  const Long3 f = F.cast<long double>(), C = f.transpose() * f;
  if (law == "stvk") {
    const Long3 E = (C - Long3::Identity()) / 2;
    return lambda / 2 * E.trace() * E.trace() + mu * (E * E).trace();
  }
  const long double log_J = std::log(f.determinant());
  return mu / 2.0L * (C.trace() - 3) - mu * log_J + lambda / 2.0L * log_J * log_J;
}

/// Calls check(law) for both laws, continued or not.
template <class Check>
void for_each_law(bool continued, const Check& check) {
  for (const char* name : {"stvk", "neo_hookean"}) with_law<double>({name, {lambda, mu}, 1000}, continued, check);
}

}  // namespace

TEST_CASE("energies agree with the formulas as written") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 300; ++i) {
    const Mat3 F = random_gradient(random, 0.8, 5);
    for (const bool continued : {false, true})
      for_each_law(continued, [&](const auto& law) {
        CHECK(law.energy(invariants_of(F)) ==
              doctest::Approx(static_cast<double>(written(law.name, F))).epsilon(1e-12));
      });
  }
}

TEST_CASE("without continuation the formula holds down to flat, and says where it ends") {
  std::mt19937_64 random(4);
  for (int i = 0; i < 300; ++i) {
    const Mat3 F = random_gradient(random, 0.02, 1);
    for_each_law(false, [&](const auto& law) {
      CHECK(law.valid(invariants_of(F)));
      CHECK(law.energy(invariants_of(F)) == doctest::Approx(static_cast<double>(written(law.name, F))).epsilon(1e-11));
    });
  }
  const Invariants<double> flat{2, 1, 0}, inverted{3, 3, -1};
  CHECK_FALSE(NeoHookean<double, false>{lambda, mu}.valid(flat));
  CHECK_FALSE(NeoHookean<double, false>{lambda, mu}.valid(inverted));
  CHECK(NeoHookean<double, true>{lambda, mu}.valid(inverted));
  CHECK(StVK<double, false>{lambda, mu}.valid(inverted));
}

TEST_CASE(
    "stress is the gradient of the energy, and its differential that of the stress, inverted too when continued") {
  std::mt19937_64 random(5);
  for (const bool continued : {false, true})
    for (int i = 0; i < 200; ++i) {
      Mat3 F = random_gradient(random, 0.3, 3);
      if (continued && i % 2) F.col(0) *= -1;
      Mat3 dF;
      for (int k = 0; k < 9; ++k) dF(k) = test::uniform(random, -1, 1);
      for_each_law(continued, [&](const auto& law) {
        const double h = 1e-5;
        const auto W = [&](double t) { return law.energy(invariants_of(Mat3(F + t * dF))); };
        const auto P = [&](double t) { return first_piola(law, Mat3(F + t * dF)); };
        // Fourth-order differences, so that truncation stays under 1e-9.
        const double slope = (8 * (W(h) - W(-h)) - (W(2 * h) - W(-2 * h))) / (12 * h);
        const double scale = first_piola(law, F).norm() + mu;
        CHECK(std::abs(first_piola(law, F).cwiseProduct(dF).sum() - slope) <= 1e-8 * scale * dF.norm());
        const Mat3 difference = (8 * (P(h) - P(-h)) - (P(2 * h) - P(-2 * h))) / (12 * h);
        const Mat3 differential = first_piola_differential(law, F, dF);
        CHECK((differential - difference).norm() <= 1e-7 * (differential.norm() + mu));
      });
    }
}

TEST_CASE("continuations are smooth where they begin: value, slope and curvature") {
  const double e = 1e-9;
  const auto checks = [&](const auto& law, double J0, bool curvature) {
    const Invariants<double> below{2.5, 2, J0 - e}, above{2.5, 2, J0 + e};
    const double scale = lambda + 2 * mu;
    CHECK(law.energy(below) == doctest::Approx(law.energy(above)).epsilon(1e-6));
    CHECK(std::abs(law.slopes(below).wJ - law.slopes(above).wJ) <= 1e-6 * scale);
    if (curvature) CHECK(law.curvatures(below).wJJ == doctest::Approx(law.curvatures(above).wJJ).epsilon(1e-6));
  };
  checks(NeoHookean<double, true>{lambda, mu}, NeoHookean<double, true>::J0, true);
  checks(StVK<double, true>{lambda, mu}, StVK<double, true>::J1, false);
}

TEST_CASE("for small strains both laws are Hooke's with the stated Young's modulus and Poisson's ratio") {
  const double young = 1e4, poisson = 0.45;
  const Lame lame = lame_from(young, poisson);
  for (const char* name : {"stvk", "neo_hookean"})
    with_law<double>({name, {lame.lambda, lame.mu}, 1000}, false, [&](const auto& law) {
      const double e = 1e-6;
      const Mat3 F = Vec3(1 + e, 1 - poisson * e, 1 - poisson * e).asDiagonal();
      const Mat3 P = first_piola(law, F);
      CHECK(P(0, 0) == doctest::Approx(young * e).epsilon(1e-4));
      CHECK(std::abs(P(1, 1)) <= 1e-4 * young * e);
    });
  CHECK(engineering_from(lame).young == doctest::Approx(young).epsilon(1e-14));
  CHECK(engineering_from(lame).poisson == doctest::Approx(poisson).epsilon(1e-14));
}

TEST_CASE("uniaxial stress of neo-Hooke matches its closed form") {
  // Free sides: mu (s² − 1) + lambda ln(t s²) = 0 for the lateral stretch s; then P11 = (mu (t² − 1) + lambda ln J)/t.
  const NeoHookean<double, false> law{lambda, mu};
  for (const double t : {0.5, 0.8, 1.3, 2.0}) {
    double low = 0.1, high = 4;
    for (int i = 0; i < 200; ++i) {
      const double s = (low + high) / 2;
      (mu * (s * s - 1) + lambda * std::log(t * s * s) > 0 ? high : low) = s;
    }
    const double s = low, log_J = std::log(t * s * s);
    const Mat3 P = first_piola(law, Mat3(Vec3(t, s, s).asDiagonal()));
    CHECK(P(0, 0) == doctest::Approx((mu * (t * t - 1) + lambda * log_J) / t).epsilon(1e-10));
    CHECK(std::abs(P(1, 1)) <= 1e-8 * mu);
  }
}

TEST_CASE("StVK loses its stiffness below a stretch of 1/√3, which the continuation prevents") {
  // Confined: P11 = (lambda + 2 mu)/2 (t³ − t), whose slope is zero at 1/√3.
  const auto P11 = [](const auto& law, double t) { return first_piola(law, Mat3(Vec3(t, 1, 1).asDiagonal()))(0, 0); };
  const double t = 1 / std::sqrt(3.0), h = 1e-4;
  const StVK<double, false> formula{lambda, mu};
  CHECK(std::abs(P11(formula, t + h) - P11(formula, t - h)) <= 1e-3 * lambda * h);
  CHECK(std::abs(P11(formula, 0.1)) < std::abs(P11(formula, t)));
  const StVK<double, true> continued{lambda, mu};
  for (double s = t; s > -0.5; s -= 0.05) CHECK(P11(continued, s - 0.05) < P11(continued, s));
}

TEST_CASE("what is wrong with a material is named") {
  const auto key = [](const Material& m) { return material_problem(m) ? material_problem(m)->first : ""; };
  CHECK(key({"stvk", {1e4, 1e3}, 1000}) == "");
  CHECK(key({"stvk", {1e4, -1}, 1000}) == "mu");
  CHECK(key({"stvk", {-1e4, 1e3}, 1000}) == "lambda");
  CHECK(key({"stvk", {NAN, 1e3}, 1000}) == "lambda");
  CHECK(key({"stvk", {1e4, 1e3}, 0}) == "density");
  CHECK(key({"stvk", {1e4}, 1000}) == "law");
  CHECK(key({"rubber", {1e4, 1e3}, 1000}) == "law");
}
