#include <bit>
#include <cmath>
#include <heml/materials/energy_graph.hpp>
#include <heml/math/elementary.hpp>

namespace heml {
namespace {

using Op = EnergyOperation;

constexpr std::size_t max_nodes = 60000;

}  // namespace

EnergyGraph::EnergyGraph(const EnergyExpression& expression, std::span<const double> parameters)
    : stretches_(expression.uses_stretches()) {
  std::vector<Node> made;
  for (const EnergyNode& node : expression.nodes) made.push_back(node_of(node, made, parameters));
  energy_ = made.back();
}

EnergyGraph::Node EnergyGraph::intern(Op operation, double value, Node a, Node b, Node c, Node d, bool positive) {
  const auto [found, is_new] = known_.try_emplace({operation, std::bit_cast<std::uint64_t>(value), a, b, c, d},
                                                  static_cast<Node>(entries_.size()));
  if (is_new) entries_.push_back({operation, value, a, b, c, d, positive});
  if (entries_.size() > max_nodes) throw EnergyError(1, "too large: its derivatives take too many operations");
  return found->second;
}

bool EnergyGraph::is(Node node, double value) const { return is_constant(node) && entries_[node].value == value; }

EnergyGraph::Node EnergyGraph::constant(double value) {
  return intern(Op::constant, value == 0 ? 0.0 : value, 0, 0, 0, 0, value > 0);
}

EnergyGraph::Node EnergyGraph::input(EnergyInput which) {
  return intern(Op::input, 0, static_cast<Node>(which), 0, 0, 0, true);
}

EnergyGraph::Node EnergyGraph::add(Node a, Node b) {
  if (is(a, 0)) return b;
  if (is(b, 0)) return a;
  if (is_constant(a) && is_constant(b)) return constant(entries_[a].value + entries_[b].value);
  if (a > b) std::swap(a, b);
  return intern(Op::add, 0, a, b, 0, 0, entries_[a].positive && entries_[b].positive);
}

EnergyGraph::Node EnergyGraph::subtract(Node a, Node b) {
  if (is(b, 0)) return a;
  if (is_constant(a) && is_constant(b)) return constant(entries_[a].value - entries_[b].value);
  if (entries_[a].operation == Op::exp && is(b, 1)) return unary(Op::expm1, entries_[a].a);  // no cancellation
  return intern(Op::subtract, 0, a, b, 0, 0, false);
}

EnergyGraph::Node EnergyGraph::multiply(Node a, Node b) {
  if (is_constant(b)) std::swap(a, b);
  if (is(a, 0)) return a;
  if (is(a, 1)) return b;
  if (is_constant(a) && is_constant(b)) return constant(entries_[a].value * entries_[b].value);
  if (is_constant(a) && entries_[b].operation == Op::multiply && is_constant(entries_[b].a))
    return multiply(multiply(a, entries_[b].a), entries_[b].b);
  if (!is_constant(a) && a > b) std::swap(a, b);
  return intern(Op::multiply, 0, a, b, 0, 0, entries_[a].positive && entries_[b].positive);
}

EnergyGraph::Node EnergyGraph::divide(Node a, Node b) {
  if (is(b, 1)) return a;
  if (is(a, 0) && !is(b, 0)) return a;
  if (is_constant(a) && is_constant(b)) return constant(entries_[a].value / entries_[b].value);
  if (is_constant(b) && std::isnormal(1 / entries_[b].value)) return multiply(constant(1 / entries_[b].value), a);
  return intern(Op::divide, 0, a, b, 0, 0, entries_[a].positive && entries_[b].positive);
}

EnergyGraph::Node EnergyGraph::unary(Op operation, Node a) {
  const double x = entries_[a].value, nan = std::numeric_limits<double>::quiet_NaN();
  if (is_constant(a)) switch (operation) {
      case Op::sqrt:
        return constant(std::sqrt(x));
      case Op::exp:
        return constant(std::isnan(x) ? nan : natural_exp(x));
      case Op::expm1:
        return constant(std::isnan(x) ? nan : natural_expm1(x));
      case Op::log:
        return constant(x > 0 && std::isnormal(x) ? natural_log(x) : nan);
      case Op::abs:
        return constant(std::abs(x));
      case Op::sign:
        return constant(x > 0 ? 1 : x < 0 ? -1 : 0);
      default:
        break;
    }
  if (operation == Op::abs && entries_[a].positive) return a;
  if (operation == Op::sign && entries_[a].positive) return constant(1);
  const bool positive = operation == Op::exp || (operation == Op::sqrt && entries_[a].positive);
  return intern(operation, 0, a, 0, 0, 0, positive);
}

/// By repeated squaring.
EnergyGraph::Node EnergyGraph::integer_power(Node a, double exponent) {
  if (exponent < 0) return divide(constant(1), integer_power(a, -exponent));
  if (exponent == 0) return constant(1);
  Node result = constant(1);
  for (auto left = static_cast<unsigned>(exponent); left > 0; left /= 2) {
    if (left % 2 == 1) result = multiply(result, a);
    if (left > 1) a = multiply(a, a);
  }
  return result;
}

EnergyGraph::Node EnergyGraph::power(Node a, Node b) {
  if (is_constant(b)) {
    const double exponent = entries_[b].value;
    if (exponent == std::trunc(exponent) && std::abs(exponent) <= 1024) return integer_power(a, exponent);
    if (exponent == 0.5) return unary(Op::sqrt, a);
    if (is_constant(a)) {
      const double x = entries_[a].value;
      const bool zero = x == 0 && exponent > 0;
      return constant(zero                        ? 0
                      : x > 0 && std::isnormal(x) ? heml::power(x, exponent)
                                                  : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return intern(Op::pow, 0, a, b, 0, 0, entries_[a].positive);
}

EnergyGraph::Node EnergyGraph::if_greater(Node a, Node b, Node c, Node d) {
  if (c == d) return c;
  if (is_constant(a) && is_constant(b)) {
    const double x = entries_[a].value, y = entries_[b].value;
    if (x > y || x <= y) return x > y ? c : d;
  }
  return intern(Op::if_greater, 0, a, b, c, d, entries_[c].positive && entries_[d].positive);
}

EnergyGraph::Node EnergyGraph::eigenvalue(std::size_t i) {
  return input(static_cast<EnergyInput>(static_cast<std::size_t>(EnergyInput::c1) + i));
}

EnergyGraph::Node EnergyGraph::variable(EnergyVariable which) {
  using enum EnergyVariable;
  const auto isochoric = [&](double exponent) { return power(input(EnergyInput::J), constant(exponent)); };
  const Node third = constant(-1.0 / 3);
  const auto c = [&](std::size_t i) { return eigenvalue(i); };
  switch (which) {
    case I1:
      return stretches_ ? add(add(c(0), c(1)), c(2)) : input(EnergyInput::I1);
    case I2:
      return stretches_ ? add(add(multiply(c(0), c(1)), multiply(c(0), c(2))), multiply(c(1), c(2)))
                        : input(EnergyInput::I2);
    case I3:
      return multiply(input(EnergyInput::J), input(EnergyInput::J));
    case J:
      return input(EnergyInput::J);
    case I4:
      return input(EnergyInput::I4);
    case I1b:
      return multiply(isochoric(-2.0 / 3), variable(I1));
    case I2b:
      return multiply(multiply(isochoric(-2.0 / 3), isochoric(-2.0 / 3)), variable(I2));
    case I4b:
      return multiply(isochoric(-2.0 / 3), variable(I4));
    case l1:
    case l2:
    case l3:
      return unary(Op::sqrt, c(static_cast<std::size_t>(which) - static_cast<std::size_t>(l1)));
    case l1b:
    case l2b:
    case l3b:
      return multiply(power(input(EnergyInput::J), third),
                      unary(Op::sqrt, c(static_cast<std::size_t>(which) - static_cast<std::size_t>(l1b))));
  }
  return 0;
}

EnergyGraph::Node EnergyGraph::node_of(const EnergyNode& node, const std::vector<Node>& made,
                                       std::span<const double> parameters) {
  const Node a = made.empty() ? 0 : made[node.a], b = made.empty() ? 0 : made[node.b];
  switch (node.kind) {
    case EnergyNode::Kind::number:
      return constant(node.value);
    case EnergyNode::Kind::variable:
      return variable(static_cast<EnergyVariable>(node.index));
    case EnergyNode::Kind::parameter:
      return constant(parameters[node.index]);
    case EnergyNode::Kind::add:
      return add(a, b);
    case EnergyNode::Kind::subtract:
      return subtract(a, b);
    case EnergyNode::Kind::multiply:
      return multiply(a, b);
    case EnergyNode::Kind::divide:
      return divide(a, b);
    case EnergyNode::Kind::negate:
      return multiply(constant(-1), a);
    case EnergyNode::Kind::call:
      break;
  }
  switch (static_cast<EnergyFunction>(node.index)) {
    case EnergyFunction::exp:
      return unary(Op::exp, a);
    case EnergyFunction::log:
      return unary(Op::log, a);
    case EnergyFunction::sqrt:
      return unary(Op::sqrt, a);
    case EnergyFunction::pow:
      return power(a, b);
    case EnergyFunction::abs:
      return unary(Op::abs, a);
    case EnergyFunction::min:
      return if_greater(b, a, a, b);
    case EnergyFunction::max:
      return if_greater(a, b, a, b);
  }
  return 0;
}

EnergyGraph::Node EnergyGraph::derivative(Node node, EnergyInput by) {
  // Operands come before what they are operands of, so one pass forward reaches everything; nodes that it adds are
  // derivatives and not needed for this one.
  std::vector<Node>& derivatives = derivatives_[static_cast<std::size_t>(by)];
  while (derivatives.size() <= node) {
    const Node next = static_cast<Node>(derivatives.size());
    const Node made = differentiate(next, by, derivatives);
    derivatives.push_back(made);
  }
  return derivatives[node];
}

EnergyGraph::Node EnergyGraph::differentiate(Node node, EnergyInput by, const std::vector<Node>& derivatives) {
  const Entry e = entries_[node];  // a copy: the list grows
  const auto d = [&](Node operand) { return derivatives[operand]; };
  switch (e.operation) {
    case Op::constant:
    case Op::sign:
      return constant(0);
    case Op::input:
      return constant(e.a == static_cast<Node>(by) ? 1 : 0);
    case Op::add:
      return add(d(e.a), d(e.b));
    case Op::subtract:
      return is(d(e.a), 0) ? multiply(constant(-1), d(e.b)) : subtract(d(e.a), d(e.b));
    case Op::multiply:
      return add(multiply(d(e.a), e.b), multiply(e.a, d(e.b)));
    case Op::divide: {
      const Node direct = divide(d(e.a), e.b);
      return is(d(e.b), 0) ? direct : subtract(direct, multiply(divide(node, e.b), d(e.b)));
    }
    case Op::sqrt:
      return is(d(e.a), 0) ? constant(0) : multiply(divide(constant(0.5), node), d(e.a));
    case Op::exp:
      return multiply(node, d(e.a));
    case Op::expm1:
      return is(d(e.a), 0) ? constant(0) : multiply(unary(Op::exp, e.a), d(e.a));
    case Op::log: {
      const Node slope = divide(d(e.a), e.a);  // defined where the logarithm is not
      if (entries_[e.a].positive || is(slope, 0)) return slope;
      return if_greater(e.a, constant(0), slope, constant(std::numeric_limits<double>::quiet_NaN()));
    }
    case Op::pow: {
      Node sum = constant(0);
      if (!is(d(e.a), 0)) {
        // x^b/x shares x^b, but is undefined at x = 0.
        const Node lower = entries_[e.a].positive ? divide(node, e.a) : power(e.a, subtract(e.b, constant(1)));
        sum = multiply(multiply(e.b, lower), d(e.a));
      }
      if (!is(d(e.b), 0)) sum = add(sum, multiply(multiply(node, unary(Op::log, e.a)), d(e.b)));
      return sum;
    }
    case Op::abs:
      return is(d(e.a), 0) ? constant(0) : multiply(unary(Op::sign, e.a), d(e.a));
    case Op::if_greater:
      return if_greater(e.a, e.b, d(e.c), d(e.d));
  }
  return 0;
}

}  // namespace heml
