#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/point.hpp>
#include <random>

#include "energy_materials.hpp"

// Laws by expression against the same laws of their own types, and their derivatives against differences.

namespace heml::energy_law_test {
namespace {

using test::energy_material;

Mat3 random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1, 1);
  Mat3 M;
  for (int i = 0; i < 9; ++i) M.data()[i] = number(random);
  return M;
}

/// The greatest entry of P and dP that one law has and the other has not, relative to the greatest.
struct Difference {
  double W, P, dP;
};
Difference difference(const MaterialPoint& a, const MaterialPoint& b, const Mat3& F, const Mat3& dF) {
  const Mat3 P = a.first_piola(F), dP = a.first_piola_differential(F, dF);
  return {std::abs(a.energy(F) - b.energy(F)) / (std::abs(a.energy(F)) + dP.norm()),
          (P - b.first_piola(F)).norm() / (P.norm() + dP.norm()),
          (dP - b.first_piola_differential(F, dF)).norm() / dP.norm()};
}

}  // namespace

TEST_CASE("every law written as an expression gives its energy, stress and stiffness") {
  std::mt19937 random(3);
  for (const test::SameEnergy& same : test::same_energies()) {
    INFO(same.law.law, ": ", same.expression.law);
    REQUIRE(!material_problem(same.expression));
    const auto own = make_material_point(same.law, false), other = make_material_point(same.expression, false);
    for (int i = 0; i < 200; ++i) {
      const Mat3 F = Mat3::Identity() + 0.3 * random_matrix(random), dF = random_matrix(random);
      if (F.determinant() < 0.2) continue;
      REQUIRE(other->valid(F));
      const Difference off = difference(*own, *other, F, dF);
      CHECK(off.W < 1e-13);
      CHECK(off.P < 1e-12);
      CHECK(off.dP < 1e-11);  // stretches 1e-3 apart lose three digits of their difference quotient
    }
  }
}

TEST_CASE("stretches that coincide, or nearly, have their limits") {
  std::mt19937 random(5);
  for (const test::SameEnergy& same : test::same_energies()) {
    if (!find_law(same.expression.law)->is_principal) continue;
    INFO(same.expression.law);
    const auto own = make_material_point(same.law, false), other = make_material_point(same.expression, false);
    for (const double gap : {0.0, 1e-15, 1e-12, 1e-9, 1e-7, 1e-6, 4e-6, 6e-6, 1e-5, 1e-4, 1e-2})
      for (const Vec3& c : {Vec3(1, 1 + gap, 1 - 2 * gap), Vec3(1.3, 0.8, 0.8 + gap), Vec3(1.2 + gap, 1.2, 0.6)}) {
        const Eigen::AngleAxisd turn(0.7, Vec3(1, 2, 3).normalized()), other_turn(1.1, Vec3(-2, 1, 1).normalized());
        const Mat3 F = turn.toRotationMatrix() * c.asDiagonal() * other_turn.toRotationMatrix();
        const Difference off = difference(*own, *other, F, random_matrix(random));
        CHECK_MESSAGE(off.P < 1e-13, gap);
        CHECK_MESSAGE(off.dP < 2e-10, gap);
      }
  }
}

TEST_CASE("derivatives are those of differences") {
  std::mt19937 random(11);
  for (const char* text : {"exp(I1b-3)*log(1+I2)/sqrt(J+I4)", "abs(I1-4)*pow(I2, 0.3) + min(I1, I2)*J",
                           "l1*l2^1.5/l3 + I1*J", "max(l1b-1.05, 0)^3 + l2^2*l3*I4", "pow(I1b-2, J) + pow(2, I2b)",
                           "I3*I1/(1+exp(0-J)) - I4b^-1.3", "log(l1+l2+l3)*I2b + sqrt(l2b)"}) {
    INFO(text);
    const Material material = energy_material(text, {}, Vec3(2, -1, 2) / 3);
    REQUIRE(!material_problem(material));
    const auto point = make_material_point(material, false);
    for (int i = 0; i < 20; ++i) {
      const Mat3 F = Mat3(Vec3(1.3, 1, 0.8).asDiagonal()) + 0.1 * random_matrix(random), dF = random_matrix(random);
      REQUIRE(point->valid(F));
      const double h = 1e-5;
      const double slope = (point->energy(F + h * dF) - point->energy(F - h * dF)) / (2 * h);
      const Mat3 change = (point->first_piola(F + h * dF) - point->first_piola(F - h * dF)) / (2 * h);
      const Mat3 P = point->first_piola(F), dP = point->first_piola_differential(F, dF);
      CHECK(slope == doctest::Approx(P.cwiseProduct(dF).sum()).epsilon(1e-7));
      CHECK((change - dP).norm() < 1e-6 * (1 + dP.norm()));
      const Mat3 other = random_matrix(random);
      CHECK(point->first_piola_differential(F, other).cwiseProduct(dF).sum() ==
            doctest::Approx(dP.cwiseProduct(other).sum()).epsilon(1e-9));
    }
  }
}

TEST_CASE("a state at which the expression is undefined is out of range") {
  const Mat3 I = Mat3::Identity();
  Mat3 mirrored = I;
  mirrored(0, 0) = -1;
  const auto valid = [](const std::string& text, const Mat3& F) {
    return make_material_point(energy_material(text, {}, Vec3::UnitX()), false)->valid(F);
  };
  CHECK(valid("I1", I));
  CHECK(!valid("I1", mirrored));  // J ≤ 0, as for the logarithm of J
  CHECK(!valid("I1", Mat3::Zero()));
  CHECK(!valid("1/(I1-3)", I));
  CHECK(!valid("log(J-1)", I));
  CHECK(!valid("log(0-J)", I));
  CHECK(!valid("sqrt(0-J)", I));
  CHECK(!valid("exp(1000*J)", I));
  CHECK(!valid("I1/0", I));
  CHECK(!valid("max(log(J-2), 0)*I1", I));
  CHECK(!valid("pow(J-2, 0.5)", I));
  CHECK(valid("pow(J-1, 2.5)", I));
  CHECK(!valid("sqrt(J-1)", I));  // no derivative
}

TEST_CASE("a law by expression is found by its definition") {
  const Material material = energy_material("C1*(I1b-3)", {{"C1", 3}});
  const LawInfo* law = find_law(material.law);
  REQUIRE(law);
  CHECK(law == find_law(std::string(material.law)));
  CHECK(law->name == "energy");
  REQUIRE(law->parameters.size() == 1);
  CHECK(law->parameters[0].name == "C1");
  CHECK(!law->has_fibre);
  CHECK(find_law(energy_definition("I4", {}))->has_fibre);
  CHECK(find_law(energy_definition("l1", {}))->is_principal);
  for (const char* none : {"energy", "energy(", "energy()", "energy()=", "energy(J)=J", "energy(a)=I1"})
    CHECK_MESSAGE(!find_law(none), none);
  CHECK(small_strain_moduli(energy_material("C1*(I1b-3) + 5*(J-1)^2", {{"C1", 3}})).shear == doctest::Approx(6));
}

}  // namespace heml::energy_law_test
