#include <fmt/format.h>

#include <algorithm>
#include <app/panel/icons.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/palette.hpp>

namespace heml::panel {
namespace {

constexpr float button_size = 1.95f, button_gap = 0.22f, group_gap = 0.5f, palette_pad = 0.35f,
                palette_margin = 0.7f;  // em
constexpr float key_size = 0.68f;       // of the small font

constexpr ImGuiWindowFlags palette_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoScrollWithMouse;

constexpr ToolInfo tools[] = {
    {Tool::grasper, "Grasper",
     "Grasps the tissue under the ring and pulls it along. L leaves it there as a clamp; a press on a clamp takes it up "
     "again, Del removes it.",
     Action::select_grasper, draw_forceps},
    {Tool::scalpel, "Scalpel", "Cuts along the mouse's path, as deep as the blade reaches.", Action::select_scalpel,
     draw_scalpel},
    {Tool::scissors, "Scissors",
     "Closes the jaws on the tissue along the line at the mouse and cuts what is between them. Dragged, it snips on "
     "along the way.",
     Action::select_scissors, draw_scissors},
    {Tool::cautery, "Cautery",
     "An electrode that burns the tissue within the ring and along its way: it chars, pales and shrinks, and with a "
     "depth comes apart.",
     Action::select_cautery, draw_electrode},
    {Tool::pin, "Pin", "Fixes the tissue under the ring; a click on a pin removes it.", Action::select_pin, draw_pin},
    {Tool::probe, "Probe",
     "Pushes a rigid rod with a round tip into the body, along the line of sight; the wheel "
     "pushes it deeper.",
     Action::select_probe, draw_probe},
    {Tool::suture, "Suture", "A click sets one end of a thread, the next the other; it draws them together.",
     Action::select_suture, draw_needle},
    {Tool::remover, "Remover", "Removes the tissue under the ring, one element deep.", Action::select_remover,
     draw_eraser},
    {Tool::measure, "Measure",
     "Clicks set up to three points that follow the tissue: field, distance, angle; area and volume of the piece. A "
     "fourth point begins anew.",
     Action::select_measure, draw_ruler},
    {Tool::select, "Select",
     "Clicks and drags select nodes of the surface, which the section Selection fixes, frees and loads. Shift adds, "
     "Ctrl takes away.",
     Action::select_nodes, draw_marquee},
};

struct Button {
  const char* title;
  std::string hint;
  Action action;
  Rows::Icon icon;
  bool strong = false;  // selected, or switched on
  ImU32 colour = 0;     // of the icon; 0: usual
};

std::vector<Button> tool_buttons(const PaletteState& state) {
  std::vector<Button> buttons;
  for (const ToolInfo& info : tools)
    buttons.push_back({info.title, info.hint, info.select, info.icon, info.tool == state.tool});
  return buttons;
}

std::vector<Button> other_buttons(const PaletteState& state) {
  const std::string so_far = state.filmed ? fmt::format("\n\n{} frames so far.", *state.filmed) : "";
  return {
      {"Table", "A fixed plane under the body, perpendicular to gravity, at its lowest point when added.",
       Action::toggle_table, draw_table, state.table},
      {"Fit view", "Turns the camera back to the scene's view, about the body where it is now.", Action::fit,
       draw_frame},
      {"Save image", "Writes a PNG into the working folder.", Action::screenshot, draw_camera},
      {state.filmed ? "Stop filming" : "Film",
       "Writes 30 frames per simulated second into a folder of the working folder, and at the end a video next to it "
       "if ffmpeg is installed. Includes the panel unless hidden (Tab)." +
           so_far,
       Action::record_video, draw_film, state.filmed.has_value(), state.filmed ? colours::danger : 0},
      {"Save scene",
       "Writes the opened scene with the current tissue, motion, tables and colours into the working folder. What "
       "tools did is saved by recordings only.",
       Action::save, draw_tray}};
}

void draw_key(const std::string& key, ImVec2 corner, ImU32 colour) {
  ImFont& letters = *font(Font::small);
  const float size = letters.FontSize * key_size;
  const ImVec2 extent = letters.CalcTextSizeA(size, 1e9f, 0, key.c_str());
  ImGui::GetWindowDrawList()->AddText(&letters, size, {corner.x - extent.x - em(0.12f), corner.y - extent.y}, colour,
                                      key.c_str());
}

void draw_button(Rows& rows, const Button& button, float size, std::vector<Action>& pressed) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const std::string key = key_name(button.action);
  const Rows::Icon icon = [&](ImDrawList& list, ImVec2 centre, float half, ImU32 colour) {
    const float aside = em(0.1f);  // leaves a corner to the key
    button.icon(list, {centre.x - aside, centre.y - aside}, half * 1.25f, button.colour ? button.colour : colour);
  };
  if (rows.icon_button({button.title, fmt::format("{} ({})\n\n{}", button.title, key, button.hint)}, size,
                       button.strong, icon))
    pressed.push_back(button.action);
  if (key.size() == 1) draw_key(key, {from.x + size, from.y + size}, button.strong ? colours::text : colours::muted);
  if (button.strong)
    ImGui::GetWindowDrawList()->AddRect(from, {from.x + size, from.y + size}, colours::accent,
                                        ImGui::GetStyle().FrameRounding * 1.4f, ImDrawFlags_None, em(0.1f));
}

/// Of a button, em: less where the free area is too low for all.
float size_for(std::size_t buttons, float room) {
  const float others = static_cast<float>(buttons) * button_gap + group_gap + 2 * (palette_pad + palette_margin);
  return std::min(button_size, (room / em(1) - others) / static_cast<float>(buttons));
}

}  // namespace

std::span<const ToolInfo> tool_table() { return tools; }

void draw_palette(Rows& rows, const PaletteState& state, const Area& free, std::vector<Action>& pressed, Area& place) {
  ImGui::SetNextWindowPos({free.from.x + em(palette_margin), free.from.y + em(palette_margin)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {em(palette_pad), em(palette_pad)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  const bool shown = ImGui::Begin("palette", nullptr, palette_flags | ImGuiWindowFlags_AlwaysAutoResize);
  ImGui::PopStyleVar(2);  // not of its tooltips
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, em(button_gap)});
  if (shown) {
    const std::vector<Button> first = tool_buttons(state), second = other_buttons(state);
    const float size = em(size_for(first.size() + second.size(), free.height()));
    for (const Button& button : first) draw_button(rows, button, size, pressed);
    ImGui::Dummy({0, em(group_gap - button_gap)});
    for (const Button& button : second) draw_button(rows, button, size, pressed);
  }
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  place = {from, {from.x + size.x, from.y + size.y}};
  ImGui::PopStyleVar();
  ImGui::End();
}

}  // namespace heml::panel
