#include <fmt/format.h>

#include <app/panel/undo_section.hpp>

namespace heml::panel {
namespace {

void step(int by, std::size_t times, PanelActions& out) {
  for (std::size_t k = 0; k < times; ++k) out.commands.emplace_back(StepHistory{by});
}

/// The earlier or later opening that undo or redo comes to, since no action on the body is left; null: it does not. A
/// later one waits until what was done since is undone.
const BareMeshOptions* opening_to_step_to(const Frame& frame, const MeshOpenings& openings, int by) {
  const UndoList* list = frame.undo_list.get();
  const bool has_action = list && (!list->past.empty() || (by > 0 && !list->future.empty()));
  return has_action ? nullptr : openings.at(by);
}

void draw_openings(Rows& rows, const MeshOpenings& openings, int from, int to, PanelActions& out) {
  for (int by = from; by < to; ++by)
    if (rows.button(
            {openings.text(by) + (by > 0 ? " (undone)" : ""),
             by > 0 ? "Opens the mesh again with this choice." : "Opens the mesh as it was before this choice."}))
      out.mesh_options = *openings.at(by > 0 ? by : by - 1);
}

}  // namespace

void step_history(int by, const Frame& frame, const MeshOpenings& openings, PanelActions& out) {
  if (const BareMeshOptions* opening = opening_to_step_to(frame, openings, by))
    out.mesh_options = *opening;
  else
    out.commands.emplace_back(StepHistory{by});
}

std::string undo_hint(const Frame& frame, const MeshOpenings& openings, int by) {
  const UndoList* list = frame.undo_list.get();
  if (opening_to_step_to(frame, openings, by))
    return by < 0 ? fmt::format("Opens the mesh as before; now {} (Ctrl+Z).", openings.text(0))
                  : fmt::format("Opens the mesh again, {} (Ctrl+Shift+Z).", openings.text(1));
  if (by < 0)
    return list && !list->past.empty() ? fmt::format("Undoes the {} and all since (Ctrl+Z).", list->past.back())
                                       : "Nothing to undo (Ctrl+Z).";
  return list && !list->future.empty() ? fmt::format("Redoes the {} (Ctrl+Shift+Z).", list->future.front())
                                       : "Nothing to redo (Ctrl+Shift+Z).";
}

void draw_undo_list(Rows& rows, const Frame& frame, const MeshOpenings& openings, PanelActions& out) {
  static const UndoList none{};
  const auto& [past, future, steps, settings] = frame.undo_list ? *frame.undo_list : none;
  if (past.empty() && future.empty() && !openings.at(-1) && !openings.at(1)) {
    rows.value({"Actions", "Grasps, cuts, pins, sutures and settings are listed here and can be undone."}, "none yet");
    return;
  }
  int first = 0, last = 0;
  while (openings.at(first - 1)) --first;
  while (openings.at(last + 1)) ++last;
  draw_openings(rows, openings, first + 1, 1, out);
  for (std::size_t k = 0; k < past.size(); ++k)
    if (rows.button({fmt::format("{}. {}", k + 1, past[k]), "Goes back to the state before this action."}))
      step(-1, past.size() - k, out);
  for (std::size_t k = 0; k < future.size(); ++k)
    if (rows.button({fmt::format("{}. {} (undone)", past.size() + k + 1, future[k]),
                     "Goes on to the state after this action."}))
      step(1, k + 1, out);
  draw_openings(rows, openings, 1, last + 1, out);
}

}  // namespace heml::panel
