#include <fmt/format.h>

#include <app/panel/undo_section.hpp>

namespace heml::panel {
namespace {

void step(int by, std::size_t times, PanelActions& out) {
  for (std::size_t k = 0; k < times; ++k) out.commands.emplace_back(StepHistory{by});
}

}  // namespace

std::string undo_hint(const Frame& frame, int by) {
  const UndoList* list = frame.undo_list.get();
  if (by < 0)
    return list && !list->past.empty() ? fmt::format("Undoes the {} and all since (Ctrl+Z).", list->past.back())
                                       : "Nothing to undo (Ctrl+Z).";
  return list && !list->future.empty() ? fmt::format("Redoes the {} (Ctrl+Shift+Z).", list->future.front())
                                       : "Nothing to redo (Ctrl+Shift+Z).";
}

void draw_undo_list(Rows& rows, const Frame& frame, PanelActions& out) {
  const UndoList* list = frame.undo_list.get();
  if (!list || (list->past.empty() && list->future.empty())) {
    rows.value({"Actions", "Grasps, cuts, pins, sutures and settings are listed here and can be undone."}, "none yet");
    return;
  }
  const auto& [past, future, steps, settings] = *list;
  for (std::size_t k = 0; k < past.size(); ++k)
    if (rows.button({fmt::format("{}. {}", k + 1, past[k]), "Goes back to the state before this action."}))
      step(-1, past.size() - k, out);
  for (std::size_t k = 0; k < future.size(); ++k)
    if (rows.button({fmt::format("{}. {} (undone)", past.size() + k + 1, future[k]),
                     "Goes on to the state after this action."}))
      step(1, k + 1, out);
}

}  // namespace heml::panel
