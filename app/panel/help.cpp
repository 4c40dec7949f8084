#include <algorithm>
#include <app/panel/help.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/theme.hpp>
#include <array>
#include <utility>
#include <vector>

namespace heml::panel {
namespace {

constexpr std::pair<const char*, const char*> mouse[] = {
    {"Left, on the body", "use the tool (grasper: hold and pull)"},
    {"Left on a clamp, with the grasper", "take it up again"},
    {"Left on the background, or right", "orbit the camera; right: about the tissue under the mouse"},
    {"An end of the axes in the corner", "look along that axis"},
    {"Middle, or Shift + right", "pan the camera"},
    {"Wheel", "zoom"},
    {"Double click on the background", "fit the body into view"},
    {"Drop a file", "open a scene, mesh or surface"},
    {"Gamepad, SpaceMouse", "a second hand (section Tool)"},
};

/// A line of the page: a key or mouse button, and its meaning.
struct Line {
  const char *left, *right;
};

struct Group {
  const char* title;
  std::vector<Line> lines;
  float left = 0, width = 0;  ///< pixels, of the left parts and of the whole

  void measure() {
    left = width = 0;
    for (const Line& line : lines) left = std::max(left, ImGui::CalcTextSize(line.left).x + ImGui::GetFontSize());
    for (const Line& line : lines) width = std::max(width, left + ImGui::CalcTextSize(line.right).x);
  }
  float height() const { return static_cast<float>(lines.size() + 2) * ImGui::GetTextLineHeightWithSpacing(); }
  void draw() const {
    ImGui::BeginGroup();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::accent), "%s", title);
    for (const Line& line : lines) {
      ImGui::TextUnformatted(line.left);
      ImGui::SameLine(left);  // from the left edge of the group
      ImGui::TextDisabled("%s", line.right);
    }
    ImGui::Dummy({0, em(0.4f)});
    ImGui::EndGroup();
  }
};

/// Mouse; the first keys, which stand below it; the other keys.
std::array<Group, 3> groups_of_page() {
  std::array<Group, 3> groups{Group{"Mouse", {}}, Group{"Keys", {}}, Group{"Keys", {}}};
  for (const auto& [left, right] : mouse) groups[0].lines.push_back({left, right});
  for (const KeyBinding& binding : key_bindings())
    if (binding.label[0]) groups[2].lines.push_back({binding.label, binding.meaning});
  std::vector<Line>&first = groups[1].lines, &rest = groups[2].lines;
  first.assign(rest.begin(), rest.begin() + std::ssize(rest) / 3);
  rest.erase(rest.begin(), rest.begin() + std::ssize(first));
  return groups;
}

}  // namespace

bool draw_help(ImVec2 picture, Area& place) {
  std::array<Group, 3> groups = groups_of_page();
  const ImVec2 room(picture.x - em(2), picture.y - em(2)), pad = ImGui::GetStyle().WindowPadding;
  const auto fits = [&] {
    for (Group& group : groups) group.measure();
    const float width = std::max(groups[0].width, groups[1].width) + em(2.5f) + groups[2].width;
    return width + 2 * pad.x <= room.x &&
           std::max(groups[0].height() + groups[1].height(), groups[2].height()) + 2 * pad.y <= room.y;
  };
  const bool large = fits();
  ImGui::PushFont(font(large ? Font::text : Font::small));
  const bool two_columns = large || fits();
  ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({0, 0}, room);
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.97f);
  bool open = true;
  ImGui::Begin("Mouse and keys", &open,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
  ImGui::BeginGroup();
  groups[0].draw();
  groups[1].draw();
  ImGui::EndGroup();
  if (two_columns) ImGui::SameLine(0, em(2.5f));
  groups[2].draw();
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  place = {from, {from.x + size.x, from.y + size.y}};
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) && !ImGui::IsWindowHovered()) open = false;
  ImGui::End();
  ImGui::PopFont();
  return open;
}

}  // namespace heml::panel
