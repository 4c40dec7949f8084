#include <fmt/format.h>

#include <app/panel/condition_edits.hpp>
#include <app/panel/selection_section.hpp>

namespace heml::panel {
namespace {

float half_row() { return (ImGui::GetContentRegionAvail().x - em(0.4f)) / 2; }

std::string share_text(std::size_t count, std::size_t all) {
  return count == 0 ? "none" : count == all ? "all" : fmt::format("{} of {}", count, all);
}

}  // namespace

void SelectionSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  static const std::vector<std::string> names{"rectangle", "lasso", "paint"};
  int chosen = static_cast<int>(drag_);
  if (rows.choice({"Drag", "What a drag selects: nodes of the surface within a rectangle, within the line drawn, or "
                           "within the tool's radius of where it passes. Shift adds, Ctrl takes away."},
                  chosen, names))
    drag_ = static_cast<Drag>(chosen);
  rows.check({"Through the body", "Selects also what other tissue hides. Paint does not."}, through_);
  if (selection_.is_empty() || !frame.conditions) {
    rows.value({"Selected", "Click or drag on the tissue: nodes of the surface, shown as dots."}, "nothing yet");
    return;
  }
  const std::size_t count = selection_.nodes().size();
  rows.value({"Selected", "Nodes of the surface, shown as dots. Esc forgets them."},
             fmt::format("{} node{}", count, count == 1 ? "" : "s"), colours::accent);
  draw_supports(rows, *frame.conditions, out);
  draw_loads(rows, *frame.conditions, out);
}

void SelectionSection::draw_supports(Rows& rows, const Conditions& conditions, PanelActions& out) {
  const std::vector<int>& nodes = selection_.nodes();
  rows.value({"Held", "How many of them the scene fixes or moves."},
             share_text(count_in(conditions.boundary, nodes), nodes.size()));
  const float half = half_row();
  if (rows.button({"Fix", "Fixes the selected nodes at their place at rest: tissue that has moved goes back there at "
                          "once, so best after a reset (R). Saved with the scene."},
                  half))
    out.commands.emplace_back(fixed(conditions, nodes));
  ImGui::SameLine(0, em(0.4f));
  if (rows.button({"Free", "Nothing of the scene holds or moves the selected nodes any more."}, half))
    if (auto set = freed(conditions, nodes)) out.commands.emplace_back(std::move(*set));
}

void SelectionSection::draw_loads(Rows& rows, const Conditions& conditions, PanelActions& out) {
  const std::vector<int>& nodes = selection_.nodes();
  rows.value({"Loaded", "How many of them a load of the scene pulls or presses."},
             share_text(count_in(conditions.loads, nodes), nodes.size()));
  rows.vector({"Force", "x, y, z in N, in all: the selected nodes share it equally."}, force_, "%.3g");
  const float half = half_row();
  if (rows.button({"Load", "Applies the force to the selected nodes from now on, in place of a force on the same "
                           "nodes. Saved with the scene."},
                  half))
    out.commands.emplace_back(loaded(conditions, nodes, force_));
  ImGui::SameLine(0, em(0.4f));
  if (rows.button({"Unload", "No load of the scene acts on the selected nodes any more; other nodes keep their share."},
                  half))
    if (auto set = unloaded(conditions, nodes)) out.commands.emplace_back(std::move(*set));
}

}  // namespace heml::panel
