#include <algorithm>
#include <app/panel/help.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/search.hpp>
#include <app/panel/theme.hpp>
#include <array>
#include <string>
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

/// A row: its name, and its meaning at `column`, or below where both do not fit a line. Both are wrapped at `width`.
void draw_row(const char* left, const char* right, float column, float width) {
  ImGui::PushTextWrapPos(width);
  ImGui::TextUnformatted(left);
  if (ImGui::CalcTextSize(left).x < column - ImGui::GetFontSize() + 1)  // of the widest, rounded
    ImGui::SameLine(column);
  else
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em(1));
  ImGui::PushStyleColor(ImGuiCol_Text, colours::muted);
  ImGui::TextUnformatted(right);
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
}

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
  /// room: pixels to the right edge of the window's contents.
  void draw(float room) const {
    ImGui::BeginGroup();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::accent), "%s", title);
    const float column = width > room ? std::min(left, 0.4f * room) : left;
    for (const Line& line : lines) draw_row(line.left, line.right, column, ImGui::GetCursorPosX() + room);
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
  const std::ptrdiff_t headings = 2;  // lines of the second title and the gap before it
  const std::ptrdiff_t below = (std::ssize(rest) - std::ssize(groups[0].lines) - headings) / 2;  // columns end alike
  first.assign(rest.begin(), rest.begin() + std::max<std::ptrdiff_t>(below, 0));
  rest.erase(rest.begin(), rest.begin() + std::ssize(first));
  return groups;
}

}  // namespace

std::vector<HelpEntry> find_help(const std::string& words, const std::vector<Rows::Listed>& rows) {
  std::vector<HelpEntry> found;
  const auto add = [&](HelpEntry entry) {
    if (has_words(entry.title + ' ' + entry.left + ' ' + entry.right, words)) found.push_back(std::move(entry));
  };
  for (const Group& group : groups_of_page())
    for (const Line& line : group.lines) add({group.title, line.left, line.right});
  for (const auto& [section, label] : rows)
    if (!label.hint.empty()) add({section.empty() ? "Buttons" : section, label.text, label.hint});
  return found;
}

void Help::toggle() {
  open_ = !open_;
  search_[0] = '\0';
  page_ = {0, 0};
}

void Help::draw(const Rows& rows, ImVec2 picture) {
  if (!open_) return;
  const ImVec2 room(picture.x - em(2), picture.y - em(2));
  ImGui::SetNextWindowPos({picture.x / 2, picture.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSizeConstraints({std::min(page_.x, room.x), std::min(page_.y, room.y)}, room);
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(0.97f);
  ImGui::Begin("Mouse and keys", nullptr,
               ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
  draw_search(room.x - 2 * ImGui::GetStyle().WindowPadding.x - ImGui::GetStyle().ScrollbarSize);
  if (search_[0])
    draw_found(rows, page_.x - ImGui::GetStyle().WindowPadding.x);
  else
    draw_page({room.x, room.y - ImGui::GetCursorPosY()});
  if (!search_[0]) page_ = ImGui::GetWindowSize();
  if (ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
      !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem))
    open_ = false;
  ImGui::End();
}

void Help::draw_search(float room) {
  constexpr const char* how_to_close = "Esc closes";
  const float beside = ImGui::CalcTextSize(how_to_close).x + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(std::min(em(18), room - beside));
  if (!ImGui::IsAnyItemActive()) ImGui::SetKeyboardFocusHere();  // typing searches at once
  if (ImGui::InputTextWithHint("##help", "Search keys and settings", search_.data(), search_.size()))
    need_letters(search_.data());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", how_to_close);
}

void Help::draw_page(ImVec2 room) {
  std::array<Group, 3> groups = groups_of_page();
  const ImVec2 pad = ImGui::GetStyle().WindowPadding;
  const auto fits = [&] {
    for (Group& group : groups) group.measure();
    const float width = std::max(groups[0].width, groups[1].width) + em(2.5f) + groups[2].width;
    return width + 2 * pad.x <= room.x &&
           std::max(groups[0].height() + groups[1].height(), groups[2].height()) + pad.y <= room.y;
  };
  const bool large = fits();
  const UseFont chosen(large ? Font::text : Font::small);
  const bool two_columns = large || fits();
  const float width = room.x - 2 * pad.x - (two_columns ? 0 : ImGui::GetStyle().ScrollbarSize);
  ImGui::BeginGroup();
  groups[0].draw(width);
  groups[1].draw(width);
  ImGui::EndGroup();
  if (two_columns) ImGui::SameLine(0, em(2.5f));
  groups[2].draw(width);
}

void Help::draw_found(const Rows& rows, float width) const {
  constexpr float column = 12;  // em, of the meanings
  const std::vector<HelpEntry> found = find_help(search_.data(), rows.listed());
  if (found.empty()) ImGui::TextDisabled("Nothing found in keys and open sections.");
  std::string heading;
  for (const auto& [title, left, right] : found) {
    if (std::exchange(heading, title) != title)
      ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colours::accent), "%s", title.c_str());
    draw_row(left.c_str(), right.c_str(), em(column), width);
  }
}

}  // namespace heml::panel
