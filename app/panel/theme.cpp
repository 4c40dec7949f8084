#include <app/panel/theme.hpp>
#include <app/render/resources.hpp>
#include <cmath>

namespace heml::panel {
namespace {

constexpr float text_size = 15, small_size = 12.5f, title_size = 19, number_size = 30;

void load_fonts(float scale) {
  static constexpr ImWchar letters[] = {0x20,   0x17f,  0x300,  0x304,  0x391,  0x3c9, 0x2010,
                                        0x2026, 0x2080, 0x2089, 0x2202, 0x2265, 0};
  const std::string_view file = render::resource("Roboto-Medium.ttf");
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  for (const float size : {text_size, small_size, title_size, number_size}) {
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 2;
    atlas.AddFontFromMemoryTTF(const_cast<char*>(file.data()), static_cast<int>(file.size()), std::round(size * scale),
                               &config, letters);
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
