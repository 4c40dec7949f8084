#pragma once
// Quantities as people type them: "16ms", "1 mm", "0.5e-3 s".
#include <string>

namespace heml {

/// s, from s, ms or us. option: named in errors ("--within"). Throws UsageError for what is no number, has no unit or
/// another one, or is not greater than 0.
double seconds_from(const std::string& text, const std::string& option);
/// m, from m, cm, mm or um; likewise.
double metres_from(const std::string& text, const std::string& option);

}  // namespace heml
