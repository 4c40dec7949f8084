#include <doctest/doctest.h>

#include <cmath>
#include <heml/materials/point.hpp>
#include <random>

#include "energy_materials.hpp"

// The grammar, by the values of expressions at a deformation where everything is known, and errors with their columns.

namespace heml::energy_expression_test {
namespace {

/// W of an expression at F = diag(2, 1, ½), J = 1, with fibre x and the parameters q = 3, r0 = 0.25 where it names
/// them.
double value_of(const std::string& text) {
  std::vector<std::pair<std::string, double>> used;
  if (text.find('q') != std::string::npos && text.find("sqrt") == std::string::npos) used.emplace_back("q", 3);
  if (text.find("r0") != std::string::npos) used.emplace_back("r0", 0.25);
  const Material material = test::energy_material(text, used, Vec3::UnitX());
  REQUIRE_MESSAGE(!material_problem(material), text);
  const Mat3 F = Vec3(2, 1, 0.5).asDiagonal();
  return make_material_point(material, false)->energy(F);
}

std::size_t column_of(const std::string& text, const std::vector<std::string>& parameters = {}) {
  try {
    parse_energy(text, parameters);
  } catch (const EnergyError& error) {
    return error.column;
  }
  return 0;
}

}  // namespace

TEST_CASE("expressions are evaluated as written") {
  const std::pair<const char*, double> cases[] = {
      {"1 + 2*3", 7},
      {"2^3^2", 512},
      {"-2^2", -4},
      {"2^-2", 0.25},
      {"(-2)^2", 4},
      {"--3", 3},
      {"7 - 3 - 2", 2},
      {"24/4/3", 2},
      {"1.5e2 + .5", 150.5},
      {"pow(q, 2)", 9},
      {"q^r0^0", 3},
      {"min(q, r0)", 0.25},
      {"max(1, -2)", 1},
      {"abs(0-3)", 3},
      {"sqrt(16)", 4},
      {"exp(0)", 1},
      {"log(1)", 0},
      {"I1", 5.25},
      {"I2", 4 + 1 + 0.25},
      {"I3", 1},
      {"J", 1},
      {"I4", 4},
      {"I4b", 4},
      {"l1", 2},
      {"l2", 1},
      {"l3", 0.5},
      {"l1b*l2b*l3b", 1},
      {"I1 + l1", 7.25},
      {"pow(l1, 2.5)", std::pow(2.0, 2.5)},
      {"pow(l1-2, 2.5)", 0},
      {"(J-1)^3 + J", 1},
      {"exp(J-1) - 1", 0},
  };
  for (const auto& entry : cases)
    CHECK_MESSAGE(value_of(entry.first) == doctest::Approx(entry.second).epsilon(1e-14), entry.first);
}

TEST_CASE("isochoric names are those of F scaled to J = 1") {
  const Mat3 F = Vec3(2.2, 1.1, 0.9).asDiagonal();
  const double J = F.determinant();
  const auto W = [&](const std::string& text) {
    return make_material_point(test::energy_material(text, {}, Vec3::UnitY()), false)->energy(F);
  };
  const Mat3 C = F * F;
  CHECK(W("I1b") == doctest::Approx(C.trace() * std::pow(J, -2.0 / 3)).epsilon(1e-14));
  CHECK(W("I2b") ==
        doctest::Approx((C.trace() * C.trace() - (C * C).trace()) / 2 * std::pow(J, -4.0 / 3)).epsilon(1e-14));
  CHECK(W("I4b") == doctest::Approx(1.21 * std::pow(J, -2.0 / 3)).epsilon(1e-14));
  CHECK(W("I3") == doctest::Approx(J * J).epsilon(1e-14));
  CHECK(W("l3b") == doctest::Approx(0.9 / std::cbrt(J)).epsilon(1e-14));
}

TEST_CASE("an error names the column") {
  CHECK(column_of("I1 + ") == 6);
  CHECK(column_of("I1 + * 2") == 6);
  CHECK(column_of("I1 ? 2") == 4);
  CHECK(column_of("(I1") == 4);
  CHECK(column_of("I1)") == 3);
  CHECK(column_of("I1 + I5") == 6);
  CHECK(column_of("exp I1") == 5);
  CHECK(column_of("max(I1)") == 7);
  CHECK(column_of("1e999*I1") == 1);
  CHECK(column_of("I1 + 2x") == 7);
  CHECK(column_of("") == 1);
  CHECK(column_of("I1 I2") == 4);
  CHECK(column_of("1.2.3") == 4);
  CHECK(column_of("J", {"C1"}) == 1);  // not used
  CHECK(column_of("C1*J", {"C1"}) == 0);
}

TEST_CASE("names of parameters are identifiers that nothing else has") {
  for (const char* good : {"C1", "kappa", "_x", "I5", "lambda"}) CHECK_MESSAGE(energy_name_problem(good).empty(), good);
  for (const char* bad : {"I1", "J", "l3b", "exp", "max", "", "2a", "a b", "κ", "a)"})
    CHECK_MESSAGE(!energy_name_problem(bad).empty(), bad);
}

TEST_CASE("deep and long expressions are refused") {
  const std::string many(20000, '(');
  CHECK(column_of(many) > 0);
  CHECK(column_of(std::string(5000, '-') + "1") > 0);
  CHECK(column_of(std::string(500, '(') + "1" + std::string(500, ')')) > 0);
  std::string powers = "J";
  for (int i = 0; i < 500; ++i) powers += "^J";
  CHECK(column_of(powers) > 0);
  std::string products = "(1+I1*J)";
  for (int i = 0; i < 800; ++i) products += "*(" + std::to_string(i) + "+I1*exp(J))";
  const auto problem = material_problem(test::energy_material(products));
  REQUIRE(problem);
  CHECK(problem->first == "law");  // longer than an expression may be
  std::string functions = "J";
  for (int i = 0; i < 60; ++i) functions = "exp(J*" + functions + "+I2)*sqrt(I1+I4+" + std::to_string(i) + ")";
  const auto large = material_problem(test::energy_material(functions, {}, Vec3::UnitX()));
  CHECK(large);
}

TEST_CASE("random text is read or refused with a column") {
  std::mt19937 random(7);
  const std::string pieces[] = {"I1", "J", "l2b",      "(",    ")",     "+",   "-",   "*", "/",
                                "^",  ",", "exp(",     "max(", "pow(",  "1.5", "1e9", ".", " ",
                                "C",  "x", "\xce\xba", "\x01", "sqrt(", "I4",  "0"};
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text;
    for (std::size_t n = 1 + random() % 12; n > 0; --n) text += pieces[random() % std::size(pieces)];
    try {
      parse_energy(text, {});
      const auto problem = material_problem(test::energy_material(text, {}, Vec3::UnitZ()));
      CHECK_MESSAGE(!problem, text);
      ++read;
    } catch (const EnergyError& error) {
      CHECK_MESSAGE(error.column >= 1, text);
      CHECK_MESSAGE(error.column <= text.size() + 1, text);
    }
  }
  CHECK(read > 100);
}

}  // namespace heml::energy_expression_test
