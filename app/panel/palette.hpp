#pragma once
// The palette at the left edge of the image: the tools of the hand, and what is done to the whole picture or scene.
#include <app/panel/actions.hpp>
#include <app/panel/area.hpp>
#include <app/panel/rows.hpp>
#include <optional>
#include <span>
#include <vector>

namespace heml::panel {

/// A tool as people see it. The table is in the order of Tool.
struct ToolInfo {
  Tool tool;
  const char* title;
  const char* hint;
  Action select;
  void (*icon)(ImDrawList&, ImVec2, float, ImU32);
};
std::span<const ToolInfo> tool_table();

struct PaletteState {
  Tool tool = Tool::grasper;   ///< selected
  bool table = false;          ///< there is one
  std::optional<long> filmed;  ///< frames so far; none: no film is made
};

/// Draws the palette at the left edge of the free area. Adds the actions of its buttons to `pressed`. `place`: set to
/// its rectangle.
void draw_palette(Rows& rows, const PaletteState& state, const Area& free, std::vector<Action>& pressed, Area& place);

}  // namespace heml::panel
