#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <heml/materials/energy_expression.hpp>

namespace heml {
namespace {

using Kind = EnergyNode::Kind;

constexpr std::string_view variable_names[] = {"I1",  "I2", "I3", "J",  "I1b", "I2b", "I4",
                                               "I4b", "l1", "l2", "l3", "l1b", "l2b", "l3b"};
constexpr std::string_view function_names[] = {"exp", "log", "sqrt", "pow", "abs", "min", "max"};

constexpr std::size_t max_length = 10000;  ///< characters
constexpr int max_depth = 100;             ///< nested parentheses, signs and powers

constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

template <class List>
std::size_t position_in(const List& names, std::string_view name) {
  return static_cast<std::size_t>(std::find(std::begin(names), std::end(names), name) - std::begin(names));
}

class Parser {
 public:
  Parser(std::string_view text, const std::vector<std::string>& parameters)
      : text_(text), parameters_(parameters), used_(parameters.size(), false) {}

  EnergyExpression run() {
    if (text_.size() > max_length)
      throw EnergyError(max_length + 1, fmt::format("longer than {} characters", max_length));
    sum();
    if (!at_end()) fail(fmt::format("unexpected {}", next_shown()));
    for (std::size_t i = 0; i < used_.size(); ++i)
      if (!used_[i]) throw EnergyError(1, fmt::format("the parameter '{}' is not used", parameters_[i]));
    return {std::move(nodes_)};
  }

 private:
  /// Counts nested calls, which the stack limits.
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > max_depth) parser_.fail(fmt::format("nested deeper than {}", max_depth));
    }
    ~Depth() { --parser_.depth_; }

   private:
    Parser& parser_;
  };

  [[noreturn]] void fail(const std::string& problem) { throw EnergyError(at_ + 1, problem); }

  void skip_spaces() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n')) ++at_;
  }
  bool at_end() {
    skip_spaces();
    return at_ == text_.size();
  }
  std::string next_shown() {
    if (at_end()) return "end";
    const char c = text_[at_];
    return c > ' ' && c <= '~' ? fmt::format("'{}'", c) : std::string("character");
  }
  bool take(char c) {
    if (at_end() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(fmt::format("'{}' expected, found {}", c, next_shown()));
  }

  std::size_t add(const EnergyNode& node) {
    nodes_.push_back(node);
    return nodes_.size() - 1;
  }

  std::size_t sum() {
    const Depth depth(*this);
    std::size_t left = product();
    for (;;) {
      const Kind kind = take('+') ? Kind::add : take('-') ? Kind::subtract : Kind::call;
      if (kind == Kind::call) return left;
      const std::size_t right = product();
      left = add({kind, 0, 0, left, right});
    }
  }

  std::size_t product() {
    std::size_t left = unary();
    for (;;) {
      const Kind kind = take('*') ? Kind::multiply : take('/') ? Kind::divide : Kind::call;
      if (kind == Kind::call) return left;
      const std::size_t right = unary();
      left = add({kind, 0, 0, left, right});
    }
  }

  std::size_t unary() {
    const Depth depth(*this);
    if (take('+')) return unary();
    if (!take('-')) return power();
    const std::size_t operand = unary();
    return add({Kind::negate, 0, 0, operand, operand});
  }

  std::size_t power() {
    const std::size_t base = atom();
    if (!take('^')) return base;
    const std::size_t exponent = unary();
    return add({Kind::call, 0, static_cast<std::size_t>(EnergyFunction::pow), base, exponent});
  }

  std::size_t atom() {
    if (take('(')) {
      const std::size_t inside = sum();
      expect(')');
      return inside;
    }
    if (at_end()) fail("a number, a name or '(' expected, found end");
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    if (is_letter(text_[at_])) return name();
    fail(fmt::format("a number, a name or '(' expected, found {}", next_shown()));
  }

  std::size_t number() {
    EnergyNode node{Kind::number};
    const char *from = text_.data() + at_, *end = text_.data() + text_.size();
    const auto [to, error] = std::from_chars(from, end, node.value);
    if (error == std::errc::result_out_of_range || !std::isfinite(node.value)) fail("the number is out of range");
    if (error != std::errc()) fail("no number");
    at_ += static_cast<std::size_t>(to - from);
    if (at_ < text_.size() && (is_letter(text_[at_]) || text_[at_] == '.'))
      fail(fmt::format("unexpected {} after a number", next_shown()));
    return add(node);
  }

  std::size_t name() {
    const std::size_t from = at_;
    while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]))) ++at_;
    const std::string_view word = text_.substr(from, at_ - from);
    if (const std::size_t k = position_in(function_names, word); k < std::size(function_names)) return call(k);
    if (const std::size_t k = position_in(variable_names, word); k < std::size(variable_names))
      return add({Kind::variable, 0, k});
    const std::size_t k = position_in(parameters_, word);
    if (k == parameters_.size()) {
      at_ = from;
      fail(fmt::format("'{}' is no parameter; an expression also knows {} and the functions {}", word,
                       fmt::join(variable_names, ", "), fmt::join(function_names, ", ")));
    }
    used_[k] = true;
    return add({Kind::parameter, 0, k});
  }

  std::size_t call(std::size_t function) {
    expect('(');
    EnergyNode node{Kind::call, 0, function};
    node.a = node.b = sum();
    if (function == static_cast<std::size_t>(EnergyFunction::pow) ||
        function == static_cast<std::size_t>(EnergyFunction::min) ||
        function == static_cast<std::size_t>(EnergyFunction::max)) {
      expect(',');
      node.b = sum();
    }
    expect(')');
    return add(node);
  }

  std::string_view text_;
  const std::vector<std::string>& parameters_;
  std::vector<bool> used_;
  std::vector<EnergyNode> nodes_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

}  // namespace

std::span<const std::string_view> energy_variables() { return variable_names; }
std::span<const std::string_view> energy_functions() { return function_names; }

bool EnergyExpression::uses(EnergyVariable variable) const {
  return std::any_of(nodes.begin(), nodes.end(), [&](const EnergyNode& node) {
    return node.kind == Kind::variable && node.index == static_cast<std::size_t>(variable);
  });
}

bool EnergyExpression::uses_stretches() const {
  return std::any_of(nodes.begin(), nodes.end(), [](const EnergyNode& node) {
    return node.kind == Kind::variable && node.index >= static_cast<std::size_t>(EnergyVariable::l1);
  });
}

EnergyExpression parse_energy(std::string_view text, const std::vector<std::string>& parameters) {
  return Parser(text, parameters).run();
}

std::string energy_name_problem(std::string_view name) {
  if (name.empty() || name.size() > 64 || !is_letter(name.front()) ||
      !std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); }))
    return "must be a name of letters, digits and _";
  if (position_in(variable_names, name) < std::size(variable_names) ||
      position_in(function_names, name) < std::size(function_names))
    return "is reserved";
  return {};
}

}  // namespace heml
