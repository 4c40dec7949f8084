#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>
#include <heml/base/error.hpp>
#include <span>
#include <string_view>
#include <studies/quantity_text.hpp>
#include <vector>

namespace heml {
namespace {

struct Unit {
  std::string_view name;
  double factor;
};
constexpr Unit times[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6}};
constexpr Unit lengths[] = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6}};

double parse(const std::string& text, const std::string& option, std::span<const Unit> units, const char* example) {
  const auto fail = [&](const std::string& problem) {
    throw UsageError(fmt::format("{} {}: {} (for example {})", option, text, problem, example));
  };
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) fail("is not a number with a unit");
  if (!(value > 0) || !std::isfinite(value)) fail("must be greater than 0");
  std::string_view name = end;
  while (!name.empty() && name.front() == ' ') name.remove_prefix(1);
  std::vector<std::string_view> known;
  for (const Unit& unit : units) {
    if (unit.name == name) return value * unit.factor;
    known.push_back(unit.name);
  }
  fail(name.empty() ? fmt::format("has no unit; give one of {}", fmt::join(known, ", "))
                    : fmt::format("has the unit '{}'; give one of {}", name, fmt::join(known, ", ")));
  return 0;
}

}  // namespace

double seconds_from(const std::string& text, const std::string& option) { return parse(text, option, times, "16ms"); }
double metres_from(const std::string& text, const std::string& option) { return parse(text, option, lengths, "1mm"); }

}  // namespace heml
