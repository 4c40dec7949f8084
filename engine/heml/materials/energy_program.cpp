#include <algorithm>
#include <heml/materials/energy_program.hpp>
#include <limits>

namespace heml {
namespace {

using Op = EnergyOperation;
using Step = EnergyStep<double>;
using Code = Step::Code;
using GraphNode = EnergyGraph::Node;

constexpr std::size_t max_steps = 20000;

std::size_t operands_of(Op operation) {
  switch (operation) {
    case Op::constant:
    case Op::input:
      return 0;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::pow:
      return 2;
    case Op::if_greater:
      return 4;
    case Op::sqrt:
    case Op::exp:
    case Op::expm1:
    case Op::log:
    case Op::abs:
    case Op::sign:
      return 1;
  }
  return 0;
}

Code code_of(Op operation) {
  switch (operation) {
    case Op::constant:
    case Op::input:
      return Code::value;
    case Op::add:
      return Code::add;
    case Op::subtract:
      return Code::subtract;
    case Op::multiply:
      return Code::multiply;
    case Op::divide:
      return Code::divide;
    case Op::sqrt:
      return Code::sqrt;
    case Op::exp:
      return Code::exp;
    case Op::expm1:
      return Code::expm1;
    case Op::log:
      return Code::log;
    case Op::pow:
      return Code::pow;
    case Op::abs:
      return Code::abs;
    case Op::sign:
      return Code::sign;
    case Op::if_greater:
      return Code::if_greater;
  }
  return Code::value;
}

/// Puts the nodes that some results need in order and assigns registers, which are reused after the last use.
class Assembler {
 public:
  explicit Assembler(const EnergyGraph& graph) : graph_(graph) {}

  EnergyProgram<double> run(const std::vector<GraphNode>& results) {
    for (const GraphNode node : results) place(node);
    count_uses(results);
    for (const GraphNode node : order_) emit(node);
    EnergyProgram<double> program{std::move(steps_), {}};
    for (const GraphNode node : results) program.results.push_back(register_[node]);
    return program;
  }

 private:
  static std::array<GraphNode, 4> operands(const EnergyGraph::Entry& e) { return {e.a, e.b, e.c, e.d}; }

  /// Whether operand k of a node is part of its step rather than in a register.
  bool is_immediate(const EnergyGraph::Entry& e, std::size_t k) const {
    const Op operation = e.operation;
    if (graph_[operands(e)[k]].operation != Op::constant) return false;
    if (operation == Op::add || operation == Op::multiply || operation == Op::divide || operation == Op::subtract)
      return k == (is_constant(e.a) ? 0u : 1u) && !(operation == Op::divide && k == 1);
    return false;
  }
  bool is_constant(GraphNode node) const { return graph_[node].operation == Op::constant; }

  /// Depth-first without recursion: operands before their node.
  void place(GraphNode root) {
    std::vector<std::pair<GraphNode, std::size_t>> left{{root, 0}};
    while (!left.empty()) {
      const GraphNode node = left.back().first;
      if (seen_.size() <= node) seen_.resize(node + 1, false);
      const EnergyGraph::Entry& e = graph_[node];
      std::size_t& k = left.back().second;
      if (seen_[node] || k == operands_of(e.operation)) {
        if (!seen_[node]) order_.push_back(node);
        seen_[node] = true;
        left.pop_back();
        if (order_.size() > max_steps) too_large();
        continue;
      }
      const std::size_t operand = k++;
      if (!is_immediate(e, operand)) left.emplace_back(operands(e)[operand], 0);
    }
  }

  void count_uses(const std::vector<GraphNode>& results) {
    uses_.assign(seen_.size(), 0);
    register_.assign(seen_.size(), 0);
    for (const GraphNode node : order_)
      for (std::size_t k = 0; k < operands_of(graph_[node].operation); ++k)
        if (!is_immediate(graph_[node], k)) ++uses_[operands(graph_[node])[k]];
    for (const GraphNode node : results) ++uses_[node];  // never released
  }

  void emit(GraphNode node) {
    const EnergyGraph::Entry& e = graph_[node];
    if (e.operation == Op::input) {
      register_[node] = static_cast<std::uint16_t>(e.a);
      uses_[node] = std::numeric_limits<std::size_t>::max() / 2;  // keeps its register
      return;
    }
    Step step{code_of(e.operation), 0, 0, 0, 0, 0, e.value};
    std::uint16_t* const to[] = {&step.a, &step.b, &step.c, &step.d};
    std::size_t filled = 0;
    for (std::size_t k = 0; k < operands_of(e.operation); ++k) {
      if (is_immediate(e, k)) {
        step.value = graph_[operands(e)[k]].value;
        step.code = immediate(e.operation, k, step.value);
      } else {
        *to[filled++] = register_[operands(e)[k]];
      }
    }
    for (std::size_t k = 0; k < operands_of(e.operation); ++k)
      if (!is_immediate(e, k)) release(operands(e)[k]);
    register_[node] = step.out = acquire();
    steps_.push_back(step);
  }

  static Code immediate(Op operation, std::size_t k, double& value) {
    switch (operation) {
      case Op::add:
        return Code::add_value;
      case Op::multiply:
        return Code::multiply_value;
      case Op::divide:
        return Code::value_divide;
      default:
        if (k == 0) return Code::value_subtract;
        value = -value;  // a − value
        return Code::add_value;
    }
  }

  std::uint16_t acquire() {
    if (!free_.empty()) {
      const std::uint16_t taken = free_.back();
      free_.pop_back();
      return taken;
    }
    if (next_ == max_energy_registers) too_large();
    return next_++;
  }

  void release(GraphNode node) {
    if (--uses_[node] == 0) free_.push_back(register_[node]);
  }

  [[noreturn]] static void too_large() { throw EnergyError(1, "too large: its derivatives take too many operations"); }

  const EnergyGraph& graph_;
  std::vector<bool> seen_;
  std::vector<GraphNode> order_;
  std::vector<std::size_t> uses_;
  std::vector<std::uint16_t> register_, free_;
  std::vector<Step> steps_;
  std::uint16_t next_ = energy_inputs;
};

template <class Real>
EnergyProgram<Real> converted(const EnergyProgram<double>& from) {
  EnergyProgram<Real> to{{}, from.results};
  for (const Step& s : from.steps)
    to.steps.push_back(
        {static_cast<typename EnergyStep<Real>::Code>(s.code), s.out, s.a, s.b, s.c, s.d, static_cast<Real>(s.value)});
  return to;
}

}  // namespace

template <class Real>
EnergyPrograms<Real> compile_energy(const EnergyExpression& expression, std::span<const double> parameters) {
  EnergyGraph graph(expression, parameters);
  using enum EnergyInput;
  const std::vector<EnergyInput> inputs =
      expression.uses_stretches() ? std::vector{c1, c2, c3, J, I4} : std::vector{I1, I2, J, I4};
  std::vector<GraphNode> first, second;
  for (const EnergyInput input : inputs) first.push_back(graph.derivative(graph.energy(), input));
  for (std::size_t i = 0; i < inputs.size(); ++i)
    for (std::size_t j = i; j < inputs.size(); ++j) second.push_back(graph.derivative(first[i], inputs[j]));
  return {converted<Real>(Assembler(graph).run({graph.energy()})), converted<Real>(Assembler(graph).run(first)),
          converted<Real>(Assembler(graph).run(second))};
}

template EnergyPrograms<float> compile_energy(const EnergyExpression&, std::span<const double>);
template EnergyPrograms<double> compile_energy(const EnergyExpression&, std::span<const double>);

}  // namespace heml
