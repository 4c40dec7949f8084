#pragma once
// The panel's rows: a label on the left, a control on the right, an explanation when the mouse rests on either.
#include <app/panel/theme.hpp>
#include <functional>
#include <span>
#include <string>

namespace heml::panel {

/// What a row is called, and what it explains when the mouse is on it. Labels are unique within a panel.
struct Label {
  std::string text;
  std::string hint;  ///< meaning and unit
};

/// What a slider spans. Logarithmic ones start above 0. A value outside widens the range to itself.
struct SliderRange {
  double low = 0, high = 1;
  const char* format = "%.3g";  ///< with the unit
  bool logarithmic = false;
};

/// Also remembers which row the mouse was on last.
class Rows {
 public:
  /// A foldable section; true while open.
  bool section(const char* title, bool open_at_first = true);

  /// True when the user changed the value.
  bool slider(const Label& label, double& value, const SliderRange& range);
  /// hints: what each name means, or nothing. An index outside the names shows "–".
  bool choice(const Label& label, int& index, std::span<const std::string> names,
              std::span<const std::string> hints = {});
  bool check(const Label& label, bool& value);

  /// The left part of a row whose controls follow.
  void name(const Label& label) { begin(label); }

  /// A number with its name; a dot before it when a colour is given.
  void value(const Label& label, const std::string& shown, ImU32 dot = 0, ImU32 colour = colours::text);

  /// A number with its name that shows more below it when pressed; true while open.
  bool folding_value(const Label& label, const std::string& shown, bool open_at_first);

  /// True when pressed. width: pixels, 0: as the text asks.
  bool button(const Label& label, float width = 0);
  /// A square button with a drawing: draw(list, centre, half size, colour).
  using Icon = std::function<void(ImDrawList&, ImVec2, float, ImU32)>;
  bool icon_button(const Label& label, float size, bool strong, const Icon& icon);

  void new_frame() { hovered_.clear(); }
  /// Explains the item just drawn when the mouse is on it.
  void explain(const Label& label);
  /// Label of the row under the mouse in this frame; empty: none.
  const std::string& hovered() const { return hovered_; }

 private:
  /// Draws the label and leaves the cursor where the control begins, with the width it gets.
  void begin(const Label& label);

  std::string hovered_;
};

/// Text whose right end is at the right edge of what is left of the line.
void text_at_right(const std::string& text, ImU32 colour);

/// Text that ends in an ellipsis where it is wider than `width` pixels.
std::string shortened(const std::string& text, float width);

}  // namespace heml::panel
