#include <fmt/format.h>

#include <algorithm>
#include <app/panel/tool_section.hpp>
#include <limits>

namespace heml::panel {
namespace {

// Relative to the body's radius.
constexpr double first_grasp = 0.12, max_grasp = 0.5, first_depth = 0.35, max_depth = 2;
constexpr double first_probe = 0.08, max_probe = 0.4, first_indentation = 0.15, max_indentation = 0.6;
constexpr double first_jaw = 0.3, min_jaw = 0.02, max_jaw = 1;
constexpr double first_burn = 0.07, min_burn = 0.01, max_burn = 0.4, first_burn_depth = 0.08, max_burn_depth = 0.6;
constexpr double max_friction = 1.5, table_gap = 0.01;

std::string several(std::size_t count, const char* what) {
  return fmt::format("Remove {} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

ToolSection::ToolSection(double body_radius, const Vec3& gravity) : body_radius_(body_radius) {
  tool_.radius = first_grasp * body_radius;
  tool_.depth = first_depth * body_radius;
  tool_.jaw_length = first_jaw * body_radius;
  tool_.jaw_opening = first_depth * body_radius;
  tool_.burn_radius = first_burn * body_radius;
  tool_.burn_depth = first_burn_depth * body_radius;
  tool_.probe_radius = first_probe * body_radius;
  tool_.indentation = first_indentation * body_radius;
  tool_.shaft = 2 * body_radius;
  sync({gravity});
}

void ToolSection::sync(const SetGravity& command) {
  if (command.gravity.norm() > 0) up_ = -command.gravity.normalized();
}

void ToolSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  draw_settings(rows);
  draw_friction(rows, frame, out);
  const std::size_t pins = tools_of<PinState>(frame.tools).size(), sutures = tools_of<SutureState>(frame.tools).size();
  if (pins > 0 && rows.button({several(pins, "pin"), "Removes all pins."})) out.commands.emplace_back(Unpin{});
  std::size_t clamps = 0;
  for (const GraspState& grasp : tools_of<GraspState>(frame.tools)) clamps += grasp.hand != 0 ? 1 : 0;
  if (clamps > 0 && rows.button({several(clamps, "clamp"), "Removes all clamps, and ends a grasp."}))
    out.commands.emplace_back(Release{std::nullopt});
  if (sutures > 0 && rows.button({several(sutures, "suture"), "Cuts all threads."}))
    out.commands.emplace_back(CutSutures{});
}

bool ToolSection::length(Rows& rows, const Label& label, double& metres, double most) {
  double millimetres = metres * 1e3;
  if (!rows.slider(label, millimetres, {0, most * body_radius_ * 1e3, "%.1f mm", false})) return false;
  metres = millimetres * 1e-3;
  return true;
}

void ToolSection::draw_settings(Rows& rows) {
  switch (tool_.tool) {
    case Tool::scalpel:
      length(rows, {"Depth", "How far the blade reaches below the surface, mm, along the line of sight."}, tool_.depth,
             max_depth);
      return;
    case Tool::scissors:
      length(rows, {"Jaw length", "Length of a snip along the jaw line, mm."}, tool_.jaw_length, max_jaw);
      tool_.jaw_length = std::max(tool_.jaw_length, min_jaw * body_radius_);
      length(rows,
             {"Opening", "How far the jaws open, mm: the lower one reaches so far below the surface, along the line of "
                         "sight, and what is between them is cut."},
             tool_.jaw_opening, max_depth);
      rows.slider({"Direction", "Direction of the jaw line of a click, degrees from the right of the image, "
                                "anticlockwise. A drag snips along its own way."},
                  tool_.jaw_direction, {0, 360, "%.0f\u00b0", false});
      return;
    case Tool::cautery:
      draw_cautery(rows);
      return;
    case Tool::probe:
      length(rows, {"Tip radius", "Radius of the probe's tip and shaft, mm."}, tool_.probe_radius, max_probe);
      tool_.probe_radius = std::max(tool_.probe_radius, 0.01 * body_radius_);
      length(rows, {"Indentation", "Depth of the tip below the undeformed surface, mm."}, tool_.indentation,
             max_indentation);
      return;
    case Tool::suture:
      rows.value({"Suture", "A thread has no settings: it draws its ends together within half a second."},
                 "no settings");
      return;
    case Tool::measure:
      rows.value({"Measure", "The section above shows what is measured."}, "no settings");
      return;
    case Tool::grasper:
    case Tool::pin:
    case Tool::remover:
    case Tool::select:
      length(rows,
             {tool_.tool == Tool::pin       ? "Pin radius"
              : tool_.tool == Tool::remover ? "Remover radius"
              : tool_.tool == Tool::select  ? "Paint radius"
                                            : "Grasp radius",
              "Surface nodes within this distance of the click follow the tool, or are fixed by a pin; mm, on the rest "
              "shape. 0: a single node. The remover, and Del, remove the tissue within it, one element deep; "
              "paint selects within it."},
             tool_.radius, max_grasp);
  }
}

void ToolSection::draw_cautery(Rows& rows) {
  length(rows,
         {"Burn depth", "How far the electrode reaches below the surface, mm, along the line of sight: so deep the "
                        "tissue comes apart. 0: it burns the surface and parts nothing."},
         tool_.burn_depth, max_burn_depth);
  length(rows,
         {"Burn radius", "How far its heat reaches, mm: tissue up to half as far is coagulated, and less and less up "
                         "to the ring."},
         tool_.burn_radius, max_burn);
  tool_.burn_radius = std::max(tool_.burn_radius, min_burn * body_radius_);
  double percent = 100 * tool_.shrink;
  if (rows.slider({"Shrink", "Part of their length that coagulated lengths lose, %: 12 to 22 in heated liver, up to "
                             "43 under microwaves."},
                  percent, {0, 100 * max_shrink, "%.0f %%", false}))
    tool_.shrink = percent / 100;
}

void ToolSection::draw_friction(Rows& rows, const Frame& frame, PanelActions& out) {
  const std::vector<TableState> tables = tools_of<TableState>(frame.tools);
  if (tool_.tool != Tool::probe && tables.empty()) return;
  if (!tables.empty() && tool_.tool != Tool::probe) tool_.friction = tables.front().table.friction;
  if (!rows.slider({"Friction", "Coulomb friction coefficient of tissue on probe and table, dimensionless."},
                   tool_.friction, {0, max_friction, "%.2f", false}) ||
      tables.empty())
    return;
  SetTables set;
  for (const TableState& state : tables) {
    set.tables.push_back(state.table);
    set.tables.back().friction = tool_.friction;
  }
  out.commands.emplace_back(std::move(set));
}

void ToolSection::toggle_table(const Frame& frame, PanelActions& out) const {
  SetTables set;
  if (!find_tool<TableState>(frame.tools)) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Vec3f& x : frame.positions) lowest = std::min(lowest, up_.dot(x.cast<double>()));
    set.tables.push_back({(lowest - table_gap * body_radius_) * up_, up_, tool_.friction});
  }
  out.commands.emplace_back(std::move(set));
}

}  // namespace heml::panel
