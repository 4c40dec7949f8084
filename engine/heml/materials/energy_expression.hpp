#pragma once
// The energy of a law given as text: "C1*(I1b-3) + kappa/2*(J-1)^2". Parsed by recursive descent:
//
//   sum     = product { ("+" | "-") product }
//   product = unary { ("*" | "/") unary }
//   unary   = ("+" | "-") unary | power
//   power   = atom [ "^" unary ]                      right-associative; -x^2 is -(x^2)
//   atom    = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//
// Names are invariants and stretches (energy_variables()), functions (energy_functions()) and the law's parameters.
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace heml {

/// What an expression may depend on, in the order of energy_variables(). l1 ≥ l2 ≥ l3 are principal stretches; b: of
/// the isochoric part, J^(−1/3) F.
enum class EnergyVariable : std::uint8_t { I1, I2, I3, J, I1b, I2b, I4, I4b, l1, l2, l3, l1b, l2b, l3b };
std::span<const std::string_view> energy_variables();

enum class EnergyFunction : std::uint8_t { exp, log, sqrt, pow, abs, min, max };
std::span<const std::string_view> energy_functions();

/// One node of the syntax tree. Children come before it.
struct EnergyNode {
  enum class Kind : std::uint8_t { number, variable, parameter, add, subtract, multiply, divide, negate, call };
  Kind kind;
  double value = 0;          ///< of a number
  std::size_t index = 0;     ///< EnergyVariable, parameter or EnergyFunction
  std::size_t a = 0, b = 0;  ///< operands; "^" is a call of pow
};

/// What is wrong with an expression, and where.
struct EnergyError : std::runtime_error {
  EnergyError(std::size_t at, const std::string& problem) : std::runtime_error(problem), column(at) {}
  std::size_t column;  ///< from 1
};

struct EnergyExpression {
  std::vector<EnergyNode> nodes;  ///< the last is the whole
  bool uses(EnergyVariable variable) const;
  bool uses_fibre() const { return uses(EnergyVariable::I4) || uses(EnergyVariable::I4b); }
  bool uses_stretches() const;
};

/// Throws EnergyError: unexpected characters, unknown names, parameters that the text does not use (column 1), too long
/// or too deeply nested.
EnergyExpression parse_energy(std::string_view text, const std::vector<std::string>& parameters);

/// The problem of a parameter's name: no identifier, or reserved. Empty if there is none.
std::string energy_name_problem(std::string_view name);

}  // namespace heml
