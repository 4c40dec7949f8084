#include <fmt/format.h>

#include <app/commands/number_options.hpp>
#include <charconv>
#include <cmath>
#include <heml/scenario/solver_json.hpp>
#include <optional>
#include <string>

namespace heml {
namespace {

template <class Number>
std::optional<Number> number_from(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const char* begin = text.starts_with('+') ? text.data() + 1 : text.data();
  const auto read = std::from_chars(begin, end, value);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return value;
}

/// accepts: whether a number is valid. CLI11 takes the error message as text, empty for none.
template <class Number, class Accepts>
CLI::Validator validator(const Accepts& accepts, const std::string& what, const std::string& shown) {
  const auto problem = [accepts, what](const std::string& text) {
    const auto value = number_from<Number>(text);
    return value && accepts(*value) ? std::string() : fmt::format("is {} (must be {})", text, what);
  };
  return CLI::Validator(problem, shown);
}

}  // namespace

CLI::Validator positive_number() {
  return validator<double>([](double value) { return value > 0 && std::isfinite(value); }, "a number greater than 0",
                           "> 0");
}

CLI::Validator number_between(double low, double high) {
  const bool open = high == std::numeric_limits<double>::max();
  return validator<double>([=](double value) { return value >= low && value <= high; },
                           open ? fmt::format("a number, {} or more", low) : fmt::format("from {} to {}", low, high),
                           open ? fmt::format(">= {}", low) : fmt::format("{} to {}", low, high));
}

CLI::Validator whole_number_between(long low, long high) {
  return validator<long>([=](long value) { return value >= low && value <= high; },
                         fmt::format("a whole number from {} to {}", low, high), fmt::format("{} to {}", low, high));
}

CLI::Validator thread_count() { return whole_number_between(0, max_threads); }

}  // namespace heml
