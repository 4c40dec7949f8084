#pragma once
// Quantities as people type them: "16ms", "1 mm", "0.5e-3 s".
#include <string>

namespace heml {

/// s, from s, ms or us. option: named in errors ("--within"). Throws UsageError unless the text is a number greater
/// than 0 with one of these units.
double seconds_from(const std::string& text, const std::string& option);
/// m, from m, cm, mm or um; likewise.
double metres_from(const std::string& text, const std::string& option);

}  // namespace heml
