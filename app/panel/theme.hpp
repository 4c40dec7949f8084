#pragma once
// The panel's theme: charcoal and muted teal, one typeface in four sizes, lengths in units of the text size.
#include <imgui.h>

#include <string_view>

namespace heml::panel {

namespace colours {
constexpr ImU32 rgba(unsigned rgb, unsigned alpha = 255) {
  return (alpha << 24) | ((rgb & 0xff) << 16) | (rgb & 0xff00) | (rgb >> 16);
}
constexpr ImU32 background = rgba(0x15191b, 226);
constexpr ImU32 edge = rgba(0x3a4447, 150);
constexpr ImU32 track = rgba(0x2a3235);
constexpr ImU32 track_hovered = rgba(0x333d41);
constexpr ImU32 fill = rgba(0x2f6660);
constexpr ImU32 text = rgba(0xdfe6e5);
constexpr ImU32 muted = rgba(0x8f9c9d);
constexpr ImU32 faint = rgba(0x566164);
constexpr ImU32 accent = rgba(0x58b8a9);
constexpr ImU32 warning = rgba(0xe2ab5f);
constexpr ImU32 danger = rgba(0xe4776c);
constexpr ImU32 kinetic = rgba(0xe0b15c);
constexpr ImU32 elastic = accent;
constexpr ImU32 potential = rgba(0x86a3e0);
}  // namespace colours

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

/// Loads the fonts of the current ImGui context for a scale (1: 15 pixels of text) and sets its style.
void apply_theme(float scale);

}  // namespace heml::panel
