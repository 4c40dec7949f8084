#pragma once
// The list of actions: what can be undone and redone; a click goes there.
#include <app/panel/actions.hpp>
#include <app/panel/mesh_openings.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

/// "Undo grasp (Ctrl+Z)." or why there is nothing to undo; by: −1 undo, 1 redo.
std::string undo_hint(const Frame& frame, const MeshOpenings& openings, int by);

/// Undoes (by: −1) or redoes (1) an action on the body; where there is none left, the mesh is opened as it was before.
void step_history(int by, const Frame& frame, const MeshOpenings& openings, PanelActions& out);

/// openings: of a bare mesh, which come before the actions on its body.
void draw_undo_list(Rows& rows, const Frame& frame, const MeshOpenings& openings, PanelActions& out);

}  // namespace heml::panel
