#pragma once
// What texts say, and changed copies of texts.
#include <doctest/doctest.h>

#include <initializer_list>
#include <string>

namespace heml {

/// Whether the text holds every part; tells the first one that is missing.
inline bool says(const std::string& text, std::initializer_list<std::string> parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos) {
      MESSAGE("'", text, "' does not say '", part, "'");
      return false;
    }
  return true;
}

inline bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The text with `from`, which it must hold, replaced by `to` at its first place.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace heml
