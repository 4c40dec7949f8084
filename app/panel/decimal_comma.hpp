#pragma once
// Decimal commas in numbers that are typed or pasted. Dear ImGui drops commas, which would make 25 of "2,5".
#include <imgui.h>

#include <string>
#include <string_view>

namespace heml::panel {

/// A number with a point for its decimal comma: "2,5" is 2.5, as are "1.234,5" 1234.5 and "1,234.5" and "1,234,567"
/// without their groups' commas.
std::string with_decimal_point(std::string_view number);

/// While it lives, commas that are typed or pasted are points: around the control that takes them.
class CommaAsPoint {
 public:
  explicit CommaAsPoint(bool active);  ///< active: whether the control takes letters
  ~CommaAsPoint();
  CommaAsPoint(const CommaAsPoint&) = delete;
  CommaAsPoint& operator=(const CommaAsPoint&) = delete;

 private:
  const char* (*clipboard_)(void*);  ///< the one of before
};

}  // namespace heml::panel
