#pragma once
// An energy and its derivatives as flat lists of operations on registers, run on numbers or on packs of elements: one
// choice of operation per pack, not per element.
#include <array>
#include <cmath>
#include <heml/materials/energy_graph.hpp>
#include <heml/math/elementary.hpp>
#include <heml/math/scalar.hpp>
#include <memory>

namespace heml {

inline constexpr std::size_t max_energy_registers = 128;

/// r[out] = a ∘ b. Of sums, products and quotients one operand may be `value`: the codes that end in _value.
template <class Real>
struct EnergyStep {
  enum class Code : std::uint16_t {
    value,
    add,
    add_value,  ///< a + value
    subtract,
    value_subtract,  ///< value − a
    multiply,
    multiply_value,
    divide,
    value_divide,  ///< value / a
    sqrt,
    exp,
    expm1,
    log,
    pow,
    abs,
    sign,
    if_greater
  };
  Code code;
  std::uint16_t out, a, b, c, d;
  Real value;
};

/// A program: registers 0 .. energy_inputs − 1 are inputs; result k is in register results[k].
template <class Real>
struct EnergyProgram {
  std::vector<EnergyStep<Real>> steps;
  std::vector<std::uint16_t> results;
};

/// W, its first derivatives by the inputs, and its second (upper triangle by rows): by I1, I2, J, I4, or by c1, c2, c3,
/// J, I4.
template <class Real>
struct EnergyPrograms {
  EnergyProgram<Real> energy, first, second;
};

/// Throws EnergyError if the expression takes too many operations.
template <class Real>
EnergyPrograms<Real> compile_energy(const EnergyExpression& expression, std::span<const double> parameters);

/// What the loops need of a program. Plain pointers: code for other instruction sets shares no function.
template <class Real>
struct EnergySteps {
  const EnergyStep<Real>*begin = nullptr, *end = nullptr;
  const std::uint16_t* results = nullptr;

  EnergySteps() = default;
  explicit EnergySteps(const EnergyProgram<Real>& program)
      : begin(program.steps.data()),
        end(program.steps.data() + program.steps.size()),
        results(program.results.data()) {}
};

/// NaN where x is no positive normal number, for which natural_log() is not defined.
template <class P>
[[gnu::always_inline]] inline P checked_log(P x) {
  using Real = Lane<P>;
  const auto defined = x > P(std::numeric_limits<Real>::min()) && x < P(std::numeric_limits<Real>::max());
  return select(defined, natural_log(select(defined, x, P(1))), P(std::numeric_limits<Real>::quiet_NaN()));
}

/// Runs a program on registers r whose inputs are set. P: a number or a pack.
template <class P>
[[gnu::always_inline]] inline void run_energy(const EnergySteps<Lane<P>>& program, P* r) {
  using std::sqrt;
  using Code = typename EnergyStep<Lane<P>>::Code;
  const P nan = std::numeric_limits<Lane<P>>::quiet_NaN();
  for (const auto* step = program.begin; step != program.end; ++step) {
    const P a = r[step->a], b = r[step->b];
    P& out = r[step->out];
    switch (step->code) {
      case Code::value:
        out = P(step->value);
        break;
      case Code::add:
        out = a + b;
        break;
      case Code::add_value:
        out = a + P(step->value);
        break;
      case Code::subtract:
        out = a - b;
        break;
      case Code::value_subtract:
        out = P(step->value) - a;
        break;
      case Code::multiply:
        out = a * b;
        break;
      case Code::multiply_value:
        out = a * P(step->value);
        break;
      case Code::divide:
        out = a / b;
        break;
      case Code::value_divide:
        out = P(step->value) / a;
        break;
      case Code::sqrt:
        out = sqrt(a);
        break;
      case Code::exp:
        out = select(a == a, natural_exp(a), nan);
        break;
      case Code::expm1:
        out = select(a == a, natural_expm1(a), nan);
        break;
      case Code::log:
        out = checked_log(a);
        break;
      case Code::pow: {
        const P exponent = b * checked_log(a);
        const P power = select(exponent == exponent, natural_exp(exponent), nan);
        out = select(a == P(0) && b > P(0), P(0), power);
        break;
      }
      case Code::abs:
        out = select(a < P(0), -a, a);
        break;
      case Code::sign:
        out = select(a > P(0), P(1), select(a < P(0), P(-1), a));
        break;
      case Code::if_greater:
        out = select(a > b, r[step->c], select(a < b || a == b, r[step->d], nan));
        break;
    }
  }
}

}  // namespace heml
