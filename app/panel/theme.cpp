#include <imgui_internal.h>  // ImTextCharFromUtf8

#include <algorithm>
#include <app/panel/system_fonts.hpp>
#include <app/panel/theme.hpp>
#include <app/render/resources.hpp>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <vector>

namespace heml::panel {
namespace {

constexpr std::size_t max_further_letters = 4000;
constexpr float text_size = 15, small_size = 12.5f, title_size = 19, number_size = 30;

constexpr ImWchar own_letters[] = {0x20,   0x17f,  0x300,  0x304,  0x391,  0x3c9, 0x2010,
                                   0x2026, 0x2080, 0x2089, 0x2202, 0x2265, 0};

/// Letters that texts need beyond own_letters.
struct FurtherLetters {
  std::set<unsigned> letters;
  bool is_new = false;  ///< some are not loaded yet
};
FurtherLetters& further_letters() {
  static FurtherLetters letters;
  return letters;
}

/// A file's bytes, which live as long as the program: fonts of all sizes refer to them.
const std::string& bytes_of_font(const std::string& path) {
  static std::map<std::string, std::string> files;
  const auto [place, is_new] = files.try_emplace(path);
  if (is_new) {
    std::ifstream file(path, std::ios::binary);
    place->second.assign(std::istreambuf_iterator<char>(file), {});
  }
  return place->second;
}

void add_font(std::string_view file, float pixels, const ImWchar* letters, int index, bool merge) {
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.OversampleH = 2;
  config.FontNo = index;
  config.MergeMode = merge;
  ImGui::GetIO().Fonts->AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()),
                                             std::round(pixels), &config, letters);
}

void load_fonts(float scale) {
  static std::vector<ImWchar> own, further;  // the atlas refers to them until it is built
  own.assign(std::begin(own_letters), std::end(own_letters) - 1);
  further.clear();
  for (const unsigned letter : further_letters().letters)
    further.insert(further.end(), 2, static_cast<ImWchar>(letter));
  own.insert(own.end(), further.begin(), further.end());
  for (std::vector<ImWchar>* list : {&own, &further}) list->push_back(0);
  const std::vector<FontFile> files = fonts_with(further_letters().letters);
  further_letters().is_new = false;
  ImGui::GetIO().Fonts->Clear();
  for (const float size : {text_size, small_size, title_size, number_size}) {
    add_font(render::resource("Roboto-Medium.ttf"), size * scale, own.data(), 0, false);
    for (const FontFile& file : files)
      add_font(bytes_of_font(file.path), size * scale, further.data(), file.index, true);
  }
}

void set_lengths(ImGuiStyle& style) {
  style = ImGuiStyle();
  style.WindowPadding = {13, 11};
  style.FramePadding = {7, 3.5f};
  style.ItemSpacing = {7, 5};
  style.ItemInnerSpacing = {7, 4};
  style.WindowRounding = 9;
  style.ChildRounding = 6;
  style.FrameRounding = 5;
  style.GrabRounding = 3;
  style.PopupRounding = 6;
  style.ScrollbarRounding = 4;
  style.ScrollbarSize = 9;
  style.GrabMinSize = 4;
  style.WindowBorderSize = 1;
  style.PopupBorderSize = 1;
  style.FrameBorderSize = 0;
  style.WindowTitleAlign = {0, 0.5f};
}

/// A colour and its value in each theme.
struct ColourRow {
  ImU32* colour;
  ImU32 dark, light;
};

void set_colours(Theme theme) {
  using colours::rgba;
  static constexpr ColourRow rows[] = {
      {&colours::background, rgba(0x15191b, 226), rgba(0xf6f7f6, 236)},
      {&colours::popup, rgba(0x1c2224, 248), rgba(0xffffff, 250)},
      {&colours::edge, rgba(0x3a4447, 150), rgba(0xb4bdbc, 190)},
      {&colours::separator, rgba(0x3a4447, 110), rgba(0xb4bdbc, 150)},
      {&colours::track, rgba(0x2a3235), rgba(0xdde3e2)},
      {&colours::track_hovered, rgba(0x333d41), rgba(0xd0d8d7)},
      {&colours::fill, rgba(0x2f6660), rgba(0x9fd3ca)},
      {&colours::chart, rgba(0x0e1213, 150), rgba(0xffffff, 190)},
      {&colours::control_hovered, rgba(0x3b484c), rgba(0xc6d0ce)},
      {&colours::row_hovered, rgba(0x2f393c), rgba(0xe3e9e8)},
      {&colours::row_pressed, rgba(0x38474a), rgba(0xd3dcda)},
      {&colours::handle, rgba(0x459a8e), rgba(0x3f978b)},
      {&colours::handle_pressed, rgba(0x6cc9bb), rgba(0x2a7c71)},
      {&colours::strong_hovered, rgba(0x397a73), rgba(0x86c5ba)},
      {&colours::scrollbar, rgba(0x475458, 190), rgba(0xaab4b3, 210)},
      {&colours::scrollbar_hovered, rgba(0x5a6a6e), rgba(0x8d9998)},
      {&colours::scrollbar_pressed, rgba(0x6a7c80), rgba(0x75827f)},
      {&colours::text, rgba(0xdfe6e5), rgba(0x1b2324)},
      {&colours::muted, rgba(0x8f9c9d), rgba(0x566263)},
      {&colours::faint, rgba(0x566164), rgba(0x98a3a2)},
      {&colours::accent, rgba(0x58b8a9), rgba(0x1a756a)},
      {&colours::warning, rgba(0xe2ab5f), rgba(0x9a5c05)},
      {&colours::danger, rgba(0xe4776c), rgba(0xb93a2e)},
      {&colours::kinetic, rgba(0xe0b15c), rgba(0x8a5a08)},
      {&colours::elastic, rgba(0x58b8a9), rgba(0x1a756a)},
      {&colours::potential, rgba(0x86a3e0), rgba(0x3f62b0)},
  };
  for (const ColourRow& row : rows) *row.colour = theme == Theme::dark ? row.dark : row.light;
}

void set_colours_of(ImGuiStyle& style) {
  const auto set = [&](ImGuiCol which, ImU32 colour) { style.Colors[which] = ImGui::ColorConvertU32ToFloat4(colour); };
  const ImU32 nothing = colours::rgba(0, 0);
  set(ImGuiCol_Text, colours::text);
  set(ImGuiCol_TextDisabled, colours::muted);
  set(ImGuiCol_WindowBg, colours::background);
  set(ImGuiCol_ChildBg, nothing);
  set(ImGuiCol_PopupBg, colours::popup);
  set(ImGuiCol_Border, colours::edge);
  set(ImGuiCol_FrameBg, colours::track);
  set(ImGuiCol_FrameBgHovered, colours::track_hovered);
  set(ImGuiCol_FrameBgActive, colours::track_hovered);
  set(ImGuiCol_CheckMark, colours::accent);
  set(ImGuiCol_SliderGrab, colours::handle);
  set(ImGuiCol_SliderGrabActive, colours::handle_pressed);
  set(ImGuiCol_Button, colours::track);
  set(ImGuiCol_ButtonHovered, colours::control_hovered);
  set(ImGuiCol_ButtonActive, colours::fill);
  set(ImGuiCol_Header, nothing);
  set(ImGuiCol_HeaderHovered, colours::row_hovered);
  set(ImGuiCol_HeaderActive, colours::row_pressed);
  set(ImGuiCol_Separator, colours::separator);
  set(ImGuiCol_ScrollbarBg, nothing);
  set(ImGuiCol_ScrollbarGrab, colours::scrollbar);
  set(ImGuiCol_ScrollbarGrabHovered, colours::scrollbar_hovered);
  set(ImGuiCol_ScrollbarGrabActive, colours::scrollbar_pressed);
  set(ImGuiCol_TextSelectedBg, colours::fill);
}

}  // namespace

void need_letters(std::string_view text) {
  FurtherLetters& further = further_letters();
  const auto is_own = [](unsigned letter) {
    for (const ImWchar* range = own_letters; *range; range += 2)
      if (letter >= range[0] && letter <= range[1]) return true;
    return letter < own_letters[0] || letter > IM_UNICODE_CODEPOINT_MAX || letter == IM_UNICODE_CODEPOINT_INVALID;
  };
  const char *at = text.data(), *end = at + text.size();
  while (at < end && further.letters.size() < max_further_letters) {
    unsigned letter = 0;
    at += std::max(1, ImTextCharFromUtf8(&letter, at, end));
    if (!is_own(letter) && further.letters.insert(letter).second) further.is_new = true;
  }
}

bool has_new_letters() { return further_letters().is_new; }

ImFont* font(Font role) { return ImGui::GetIO().Fonts->Fonts[static_cast<int>(role)]; }

float em(float multiple) { return multiple * font(Font::text)->FontSize; }

void apply_theme(float scale, Theme theme) {
  set_colours(theme);
  load_fonts(scale);
  ImGuiStyle& style = ImGui::GetStyle();
  set_lengths(style);
  set_colours_of(style);
  style.ScaleAllSizes(scale);
}

}  // namespace heml::panel
