#pragma once
// The panel's rows: a label on the left, a control on the right, and a tooltip on both.
#include <app/panel/theme.hpp>
#include <functional>
#include <heml/math/types.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace heml::panel {

/// Label and tooltip of a row. Labels are unique within a panel.
struct Label {
  std::string text;
  std::string hint;  ///< meaning and unit
};

/// Range of a number; logarithmic ones start above 0. A value outside extends the range of a slider.
struct SliderRange {
  double low = 0, high = 1;
  const char* format = "%.3g";  ///< with the unit
  bool logarithmic = false;
};

/// Draws rows and records which one is under the mouse.
class Rows {
 public:
  /// A foldable section; true while open. open_at_first: where it was neither opened nor closed before.
  bool section(const char* title, bool open_at_first = true);
  /// The same where the caller keeps whether it is open.
  bool fold(const char* title, bool& open);

  /// True when the user changed the value.
  bool slider(const Label& label, double& value, const SliderRange& range);
  /// A number to type. True when it was changed: on Enter, Tab, or a click elsewhere.
  bool number(const Label& label, double& value, const SliderRange& range);
  /// Three numbers to type, each in the range. True when one was changed: on Enter, Tab, or a click elsewhere.
  bool vector(const Label& label, Vec3& value, const SliderRange& range);
  /// What became of a number typed outside its range, once; empty: nothing.
  std::string take_notice() { return std::exchange(notice_, {}); }
  /// A text to type, of at most so many bytes.
  void text(const Label& label, std::string& value, std::size_t most);
  /// hints: a tooltip per name, or none. An index outside the names shows "–".
  bool choice(const Label& label, int& index, std::span<const std::string> names,
              std::span<const std::string> hints = {});
  /// Closes what choice() has opened; true if anything was open.
  static bool close_choices();
  bool check(const Label& label, bool& value);

  /// The control of the next row ends so many pixels before the window's edge.
  void leave_room(float pixels) { room_ = pixels; }

  /// The label of a row whose controls follow.
  void name(const Label& label) { begin(label); }

  /// A labelled value, after a dot if `dot` is a colour.
  void value(const Label& label, const std::string& shown, ImU32 dot = 0, ImU32 colour = colours::text);

  /// A labelled value that opens what follows it when clicked; true while open.
  bool folding_value(const Label& label, const std::string& shown, bool open_at_first);

  /// True when pressed. width: pixels; 0: fits the text.
  bool button(const Label& label, float width = 0);
  /// A square button with an icon: draw(list, centre, half size, colour).
  using Icon = std::function<void(ImDrawList&, ImVec2, float, ImU32)>;
  bool icon_button(const Label& label, float size, bool strong, const Icon& icon);

  /// Sections that were opened or closed by hand, by title.
  const std::map<std::string, bool>& sections() const { return sections_; }
  void set_sections(std::map<std::string, bool> sections) { sections_ = std::move(sections); }

  /// lists: whether the rows of this frame are to be found in listed().
  void new_frame(bool lists = false) {
    hovered_.clear();
    section_.clear();
    lists_ = lists;
    listed_.clear();
  }
  /// A row, and the section that it stands in; empty above the first.
  struct Listed {
    std::string section;
    Label label;
  };
  const std::vector<Listed>& listed() const { return listed_; }
  /// Shows the tooltip of the item just drawn when the mouse is on it.
  void explain(const Label& label);
  /// Label of the row under the mouse in this frame; empty: none.
  const std::string& hovered() const { return hovered_; }

 private:
  void list(const Label& label);
  /// Draws the label, moves the cursor to the control and sets its width.
  void begin(const Label& label);

  bool is_typing(ImGuiID id, bool active, bool& changed, double& edited);
  double limited(const Label& label, double typed, const SliderRange& range);

  struct Typed {
    ImGuiID id;
    bool changed;
    double value;
  };
  std::string hovered_;
  bool lists_ = false;
  std::vector<Listed> listed_;
  std::string section_;  ///< the last one drawn
  float room_ = 0;  ///< leave_room()
  std::map<std::string, bool> sections_;
  std::optional<Typed> typed_;  ///< the number that is being typed
  Vec3 typed_vector_ = Vec3::Zero();  ///< as last typed
  std::string active_vector_;         ///< label of the one that takes letters; empty: none does
  std::string notice_;          ///< take_notice()
};

/// Text aligned with the right edge of the window, on the current line.
void text_at_right(const std::string& text, ImU32 colour);

std::string capitalised(std::string text);  ///< the first letter, where it is of ASCII

/// The text, cut to `width` pixels with an ellipsis.
std::string elided(const std::string& text, float width);

}  // namespace heml::panel
