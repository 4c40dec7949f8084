#include <algorithm>
#include <app/panel/help.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/theme.hpp>
#include <span>
#include <utility>

namespace heml::panel {
namespace {

constexpr std::pair<const char*, const char*> mouse[] = {
    {"Left, on the body", "use the tool (grasper: hold and pull)"},
    {"Left on the background, or right", "orbit the camera"},
    {"Middle, or Shift + right", "pan the camera"},
    {"Wheel", "zoom"},
    {"Double click on the background", "fit the body into view"},
    {"Drop a file", "open a scene, mesh or surface"},
};

/// A key or mouse button, and its meaning `gap` pixels from the group's left edge.
void line(const char* left, const char* right, float gap) {
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::text), "%s", left);
  ImGui::SameLine(gap);
  ImGui::TextDisabled("%s", right);
}

void heading(const char* text) {
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::accent), "%s", text);
  ImGui::Dummy({0, em(0.1f)});
}

void draw_mouse() {
  heading("Mouse");
  for (const auto& [left, right] : mouse) line(left, right, em(12));
}

void draw_keys(std::span<const KeyBinding> bindings) {
  heading("Keys");
  for (const KeyBinding& binding : bindings)
    if (binding.label[0]) line(binding.label, binding.meaning, em(7));
}

}  // namespace

bool draw_help(ImVec2 picture, Area& place) {
  const bool two_columns = picture.x > em(52);
  ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, {picture.x - em(2), picture.y - em(2)});
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.97f);
  bool open = true;
  ImGui::Begin("Mouse and keys", &open,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
  const std::span<const KeyBinding> keys = key_bindings();
  const std::size_t keys_in_first_column = two_columns ? keys.size() / 3 : 0;
  ImGui::BeginGroup();
  draw_mouse();
  ImGui::Dummy({0, em(0.5f)});
  if (two_columns) draw_keys(keys.first(keys_in_first_column));
  ImGui::EndGroup();
  if (two_columns) ImGui::SameLine(0, em(3));
  ImGui::BeginGroup();
  draw_keys(keys.subspan(keys_in_first_column));
  ImGui::EndGroup();
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  place = {from, {from.x + size.x, from.y + size.y}};
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered()) open = false;
  ImGui::End();
  return open;
}

}  // namespace heml::panel
