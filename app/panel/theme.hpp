#pragma once
// The panel's theme: charcoal and muted teal, one typeface in four sizes, lengths in units of the text size.
#include <imgui.h>

#include <string_view>

namespace heml::panel {

/// Colours of the panel and of marks over the image: those of the theme that was last applied.
namespace colours {
constexpr ImU32 rgba(unsigned rgb, unsigned alpha = 255) {
  return (alpha << 24) | ((rgb & 0xff) << 16) | (rgb & 0xff00) | (rgb >> 16);
}
inline ImU32 background, popup, edge, separator;         // windows
inline ImU32 track, track_hovered, fill, chart;          // bars, fields, boxes; behind a plot
inline ImU32 control_hovered, row_hovered, row_pressed;  // buttons, sections and choices
inline ImU32 handle, handle_pressed, strong_hovered;     // of sliders; a button of the accent's colour
inline ImU32 scrollbar, scrollbar_hovered, scrollbar_pressed;
inline ImU32 text, muted, faint, accent, warning, danger;
inline ImU32 kinetic, elastic, potential;  // energies
}  // namespace colours

enum class Theme { dark, light };

enum class Font { text, small, title, number };

ImFont* font(Font role);

/// A multiple of the text font's size, pixels.
float em(float multiple);

/// Sets the current font for the lifetime of the object.
class UseFont {
 public:
  explicit UseFont(Font role) { ImGui::PushFont(font(role)); }
  ~UseFont() { ImGui::PopFont(); }
  UseFont(const UseFont&) = delete;
  UseFont& operator=(const UseFont&) = delete;
};

/// Makes the fonts have the letters of a text (UTF-8), with fonts of the system where the panel's has none, from the
/// next apply_theme() on. Texts of the program itself need no call.
void need_letters(std::string_view text);
bool has_new_letters();  ///< apply_theme() is to be called for them

/// Sets the colours, loads the fonts of the current ImGui context for a scale (1: 15 pixels of text) and sets its
/// style.
void apply_theme(float scale, Theme theme = Theme::dark);

}  // namespace heml::panel
