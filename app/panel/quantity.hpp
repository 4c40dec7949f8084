#pragma once
// Numbers as text for display.
#include <string>
#include <string_view>

namespace heml::panel {

/// Three significant digits with an SI prefix: 0.00123 J is "1.23 mJ". "–" for a value that is not finite.
std::string quantity(double value, std::string_view unit);

/// A force with three significant digits in newtons, whatever its size, down to 0.001 N.
std::string newtons(double value);

/// A whole number in groups of three digits, "12 345", separated by no-break spaces.
std::string grouped_digits(long value);

}  // namespace heml::panel
