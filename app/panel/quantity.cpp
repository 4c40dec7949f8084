#include <fmt/format.h>

#include <algorithm>
#include <app/panel/quantity.hpp>
#include <cmath>

namespace heml::panel {

std::string quantity(double value, std::string_view unit) {
  if (!std::isfinite(value)) return "–";
  constexpr std::string_view prefixes[] = {"n", "µ", "m", "", "k", "M", "G"};
  constexpr double smallest = 5e-13;
  if (std::abs(value) < smallest) return fmt::format("0 {}", unit);
  // Rounded first, so that 999.9 becomes 1.00 k and never 1000.
  const int decimal = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  const double rounded = std::round(value / std::pow(10, decimal - 2)) * std::pow(10, decimal - 2);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12));
  const int group = std::clamp(static_cast<int>(std::floor(exponent / 3.0)), -3, 3);
  const int digits = std::max(0, 2 - (exponent - 3 * group));
  return fmt::format("{}{:.{}f} {}{}", rounded < 0 ? "−" : "", std::abs(rounded) / std::pow(1000.0, group), digits,
                     prefixes[group + 3], unit);
}

std::string newtons(double value) {
  if (!std::isfinite(value)) return "–";
  const double size = std::abs(value);
  return fmt::format("{}{:.{}f} N", value < 0 ? "−" : "", size,
                     size < 0.9995  ? 3
                     : size < 9.995 ? 2
                     : size < 99.95 ? 1
                                    : 0);
}

std::string grouped_digits(long value) {
  std::string digits = std::to_string(std::abs(value));
  for (std::ptrdiff_t at = std::ssize(digits) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), "\u00a0");
  return (value < 0 ? "−" : "") + digits;
}

}  // namespace heml::panel
