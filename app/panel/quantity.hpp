#pragma once
// Numbers as people read them.
#include <string>
#include <string_view>

namespace heml::panel {

/// Three significant digits with the SI prefix that suits: 0.00123 J is "1.23 mJ". "–" for what is not finite.
std::string quantity(double value, std::string_view unit);

/// A force with three significant digits in newtons, whatever its size, down to 0.001 N.
std::string newtons(double value);

/// A whole number in groups of three digits, "12 345", with a thin gap that does not break.
std::string grouped_digits(long value);

}  // namespace heml::panel
