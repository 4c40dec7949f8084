#pragma once
// The list of actions: what can be undone and redone; a click goes there.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

/// "Undo grasp (Ctrl+Z)." or why there is nothing to undo; by: −1 undo, 1 redo.
std::string undo_hint(const Frame& frame, int by);

void draw_undo_list(Rows& rows, const Frame& frame, PanelActions& out);

}  // namespace heml::panel
