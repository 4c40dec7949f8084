#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <app/panel/condition_edits.hpp>
#include <app/panel/keys.hpp>
#include <app/panel/selection_section.hpp>
#include <iterator>

namespace heml::panel {
namespace {

constexpr std::size_t max_name = 40;  // bytes, of a region
constexpr double max_force = 1e6;     // N, of a component that is typed

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
  rows.check({"Through the body",
              "Selects also what other tissue hides, and nodes inside the body. Paint selects those inside within its "
              "radius, whatever is set here."},
             through_);
  if (selection_.is_empty() || !frame.conditions) {
    rows.value({"Selected", "Click or drag on the tissue: nodes of the surface, shown as dots."}, "nothing yet");
    return;
  }
  const std::size_t count = selection_.nodes().size(), inside = inside_.nodes().size();
  rows.value({"Selected", "Nodes of the surface, shown as dots, and those inside the body, which count for regions "
                          "alone. Esc forgets them."},
             fmt::format("{} node{}", count, count == 1 ? "" : "s") +
                 (inside > 0 ? fmt::format(", {} inside", inside) : std::string()),
             colours::accent);
  draw_supports(rows, *frame.conditions, out);
  draw_loads(rows, *frame.conditions, out);
  draw_pins(rows, frame, out);
  draw_region(rows, frame, out);
}

void SelectionSection::draw_supports(Rows& rows, const Conditions& conditions, PanelActions& out) {
  const std::vector<int>& nodes = selection_.nodes();
  rows.value({"Constrained", "How many of them the scene fixes, or moves as prescribed."},
             share_text(count_in(conditions.boundary, nodes), nodes.size()));
  static const std::vector<std::string> names{"x, y and z", "x", "y", "z", "x and y", "x and z", "y and z"};
  constexpr std::array<AxisSet, 7> axes{{{},
                                         {{true, false, false}},
                                         {{false, true, false}},
                                         {{false, false, true}},
                                         {{true, true, false}},
                                         {{true, false, true}},
                                         {{false, true, true}}}};
  rows.choice({"Fix along",
               "In which directions Fix fixes the nodes. Fixed in one alone they slide on a plane: a roller, "
               "or a plane of symmetry."},
              fixed_axes_, names);
  const float half = half_row();
  if (rows.button({"Fix", "Fixes the selected nodes at their place at rest: tissue that has moved goes back there at "
                          "once, so best after a reset (R). Saved with the scene."},
                  half))
    out.commands.emplace_back(fixed(conditions, nodes, axes[static_cast<std::size_t>(fixed_axes_)]));
  ImGui::SameLine(0, em(0.4f));
  if (rows.button({"Free", "The scene constrains the selected nodes no more."}, half))
    if (auto set = freed(conditions, nodes)) out.commands.emplace_back(std::move(*set));
}

PinTissue SelectionSection::pin() const {
  PinTissue pin;
  pin.nodes = selection_.nodes();
  return pin;
}

Unpin SelectionSection::unpin() const { return {std::nullopt, selection_.nodes()}; }

void SelectionSection::draw_pins(Rows& rows, const Frame& frame, PanelActions& out) const {
  std::vector<int> pinned;
  for (const PinState& pin : tools_of<PinState>(frame.tools))
    pinned.insert(pinned.end(), pin.nodes.begin(), pin.nodes.end());
  std::sort(pinned.begin(), pinned.end());
  const auto is_pinned = [&](int node) { return std::binary_search(pinned.begin(), pinned.end(), node); };
  const std::vector<int>& nodes = selection_.nodes();
  rows.value({"Pinned", "How many of them a pin holds."},
             share_text(static_cast<std::size_t>(std::count_if(nodes.begin(), nodes.end(), is_pinned)), nodes.size()));
  const float half = half_row();
  if (rows.button({"Pin", fmt::format("Holds the selected nodes where they are now ({}). A pin is a tool: it is not "
                                      "saved with the scene.",
                                      key_name(Action::pin_selected))},
                  half))
    out.commands.emplace_back(pin());
  ImGui::SameLine(0, em(0.4f));
  if (rows.button({"Unpin", fmt::format("Pins let go of the selected nodes ({}).", key_name(Action::unpin_selected))},
                  half))
    out.commands.emplace_back(unpin());
}

void SelectionSection::draw_loads(Rows& rows, const Conditions& conditions, PanelActions& out) {
  const std::vector<int>& nodes = selection_.nodes();
  rows.value({"Loaded", "How many of them a load of the scene pulls or presses."},
             share_text(count_in(conditions.loads, nodes), nodes.size()));
  rows.vector({"Force",
               "x, y, z in N, in all: the selected nodes share it equally. The arrow in the image shows it: drag its "
               "tip to set direction and size, and to load; Shift keeps to an axis."},
              force_, {-max_force, max_force, "%.3g"});
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

/// Elements are of a region by their corners.
void SelectionSection::draw_region(Rows& rows, const Frame& frame, PanelActions& out) {
  rows.text({"Region name", "Name of the region to make. A name that there is: the elements join that region."}, name_,
            max_name);
  const float half = half_row();
  if (rows.button({"Tag as region", "Makes the elements whose corners are all selected this region, with a material "
                                    "of its own to begin with as it is. Select with \"Through the body\", or paint, "
                                    "to have those inside too. Saved with the scene."},
                  half)) {
    RegionTag tag;
    std::set_union(selection_.nodes().begin(), selection_.nodes().end(), inside_.nodes().begin(),
                   inside_.nodes().end(), std::back_inserter(tag.nodes));
    tag.name = name_;
    out.commands.emplace_back(TagRegion{std::move(tag), std::nullopt});
  }
  ImGui::SameLine(0, em(0.4f));
  if (!rows.button({"Its material", "Shows the material of the region of this name in the section below."}, half))
    return;
  if (!frame.regions) return;
  for (const auto& [number, name] : frame.regions->names)
    if (name == name_) region_ = number;
}

}  // namespace heml::panel
