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

void set_colours(ImGuiStyle& style) {
  const auto set = [&](ImGuiCol which, ImU32 colour) { style.Colors[which] = ImGui::ColorConvertU32ToFloat4(colour); };
  const ImU32 nothing = colours::rgba(0, 0);
  set(ImGuiCol_Text, colours::text);
  set(ImGuiCol_TextDisabled, colours::muted);
  set(ImGuiCol_WindowBg, colours::background);
  set(ImGuiCol_ChildBg, nothing);
  set(ImGuiCol_PopupBg, colours::rgba(0x1c2224, 248));
  set(ImGuiCol_Border, colours::edge);
  set(ImGuiCol_FrameBg, colours::track);
  set(ImGuiCol_FrameBgHovered, colours::track_hovered);
  set(ImGuiCol_FrameBgActive, colours::track_hovered);
  set(ImGuiCol_CheckMark, colours::accent);
  set(ImGuiCol_SliderGrab, colours::rgba(0x459a8e));
  set(ImGuiCol_SliderGrabActive, colours::rgba(0x6cc9bb));
  set(ImGuiCol_Button, colours::track);
  set(ImGuiCol_ButtonHovered, colours::rgba(0x3b484c));
  set(ImGuiCol_ButtonActive, colours::fill);
  set(ImGuiCol_Header, nothing);
  set(ImGuiCol_HeaderHovered, colours::rgba(0x2f393c));
  set(ImGuiCol_HeaderActive, colours::rgba(0x38474a));
  set(ImGuiCol_Separator, colours::rgba(0x3a4447, 110));
  set(ImGuiCol_ScrollbarBg, nothing);
  set(ImGuiCol_ScrollbarGrab, colours::rgba(0x475458, 190));
  set(ImGuiCol_ScrollbarGrabHovered, colours::rgba(0x5a6a6e));
  set(ImGuiCol_ScrollbarGrabActive, colours::rgba(0x6a7c80));
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

void apply_theme(float scale) {
  load_fonts(scale);
  ImGuiStyle& style = ImGui::GetStyle();
  set_lengths(style);
  set_colours(style);
  style.ScaleAllSizes(scale);
}

}  // namespace heml::panel
