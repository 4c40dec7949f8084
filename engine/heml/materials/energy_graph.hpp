#pragma once
// An energy as a graph of operations in which equal subexpressions are one node, and its derivatives by forward
// differentiation: the derivative of a graph is nodes of the same graph, so differentiating twice gives second
// derivatives that share what they can with the first.
#include <heml/materials/energy_expression.hpp>
#include <map>
#include <tuple>

namespace heml {

enum class EnergyOperation : std::uint8_t {
  constant,
  input,  ///< one of EnergyInput
  add,
  subtract,
  multiply,
  divide,
  sqrt,
  exp,
  expm1,
  log,
  pow,  ///< a^b for a ≥ 0
  abs,
  sign,       ///< −1, 0, 1
  if_greater  ///< a > b ? c : d
};

/// The independent variables of a graph. An expression of stretches depends on the eigenvalues c1 ≥ c2 ≥ c3 of C, J and
/// I4; any other on I1, I2, J and I4.
enum class EnergyInput : std::uint8_t { J, I4, I1, I2, c1 = I1, c2 = I2, c3 };
inline constexpr std::size_t energy_inputs = 5;

class EnergyGraph {
 public:
  using Node = std::uint32_t;
  struct Entry {
    EnergyOperation operation;
    double value;  ///< of a constant
    Node a, b, c, d;
    bool positive;  ///< wherever J, I1, I2, I4 and c are
  };

  /// Throws EnergyError if the graph grows too large.
  EnergyGraph(const EnergyExpression& expression, std::span<const double> parameters);

  Node energy() const { return energy_; }
  Node derivative(Node node, EnergyInput input);
  const Entry& operator[](Node node) const { return entries_[node]; }

 private:
  Node constant(double value);
  Node input(EnergyInput which);
  Node add(Node a, Node b);
  Node subtract(Node a, Node b);
  Node multiply(Node a, Node b);
  Node divide(Node a, Node b);
  Node unary(EnergyOperation operation, Node a);
  Node power(Node a, Node b);
  Node integer_power(Node a, double exponent);
  Node if_greater(Node a, Node b, Node c, Node d);
  Node intern(EnergyOperation operation, double value, Node a, Node b, Node c, Node d, bool positive);

  Node variable(EnergyVariable which);
  Node eigenvalue(std::size_t i);
  Node node_of(const EnergyNode& node, const std::vector<Node>& made, std::span<const double> parameters);
  Node differentiate(Node node, EnergyInput input, const std::vector<Node>& derivatives);

  bool is(Node node, double value) const;
  bool is_constant(Node node) const { return entries_[node].operation == EnergyOperation::constant; }

  bool stretches_;
  std::vector<Entry> entries_;
  std::map<std::tuple<EnergyOperation, std::uint64_t, Node, Node, Node, Node>, Node> known_;
  std::vector<Node> derivatives_[energy_inputs];  ///< of each node so far
  Node energy_ = 0;
};

}  // namespace heml
