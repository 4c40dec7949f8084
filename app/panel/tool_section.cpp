#include <fmt/format.h>

#include <algorithm>
#include <app/panel/tool_section.hpp>
#include <app/render/grasp_pose.hpp>
#include <cmath>
#include <limits>
#include <string_view>

namespace heml::panel {

/// A setting that is kept between runs by its name; lengths in radii of the body.
struct ToolSetting {
  std::string_view name;
  double ToolSettings::*value;
  double first, least, most;  ///< most: of the slider; more can be typed
  bool is_length = true;
};

namespace {

constexpr double max_friction = 1.5;
constexpr double table_gap = 0.01;   // radii of the body
constexpr double kept_digits = 1e4;  // of settings kept between runs: their last one is 1e-4

constexpr ToolSetting grasp_radius{"grasp radius", &ToolSettings::radius, 0.12, 0, 0.5};
constexpr ToolSetting depth{"depth", &ToolSettings::depth, 0.35, 0, 2};
constexpr ToolSetting jaw_length{"jaw length", &ToolSettings::jaw_length, 0.3, 0.02, 1};
constexpr ToolSetting jaw_opening{"jaw opening", &ToolSettings::jaw_opening, 0.35, 0, 2};
constexpr ToolSetting jaw_direction{"jaw direction", &ToolSettings::jaw_direction, 90, 0, 360, false};
constexpr ToolSetting burn_radius{"burn radius", &ToolSettings::burn_radius, 0.07, 0.01, 0.4};
constexpr ToolSetting burn_depth{"burn depth", &ToolSettings::burn_depth, 0.08, 0, 0.6};
constexpr ToolSetting shrink{"shrink", &ToolSettings::shrink, usual_shrink, 0, max_shrink, false};
constexpr ToolSetting probe_radius{"probe radius", &ToolSettings::probe_radius, 0.08, 0.01, 0.4};
constexpr ToolSetting indentation{"indentation", &ToolSettings::indentation, 0.15, 0, 0.6};
constexpr const ToolSetting* tool_settings[] = {&grasp_radius, &depth,      &jaw_length, &jaw_opening,  &jaw_direction,
                                                &burn_radius,  &burn_depth, &shrink,     &probe_radius, &indentation};

std::string several(std::size_t count, const char* what) {
  return fmt::format("Remove {} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

ToolSection::ToolSection(double body_radius, const Vec3& gravity) : body_radius_(body_radius) {
  keep({});
  tool_.shaft = 2 * body_radius;
  sync({gravity});
}

void ToolSection::keep(const std::map<std::string, double>& kept) {
  for (const ToolSetting* setting : tool_settings) {
    const auto found = kept.find(std::string(setting->name));
    const bool usable = found != kept.end() && found->second >= setting->least && found->second <= 10 * setting->most;
    tool_.*setting->value = (usable ? found->second : setting->first) * (setting->is_length ? body_radius_ : 1);
  }
}

std::map<std::string, double> ToolSection::kept() const {
  std::map<std::string, double> kept;
  for (const ToolSetting* setting : tool_settings) {
    const double value = tool_.*setting->value / (setting->is_length ? body_radius_ : 1);
    const double rounded = std::round(value * kept_digits) / kept_digits;
    if (rounded != setting->first) kept[std::string(setting->name)] = rounded;
  }
  return kept;
}

void ToolSection::sync(const SetGravity& command) {
  if (command.gravity.norm() > 0) up_ = -command.gravity.normalized();
}

void ToolSection::draw(Rows& rows, const Frame& frame, PanelActions& out) {
  draw_settings(rows);
  draw_friction(rows, frame, out);
  draw_devices(rows);
  const std::size_t pins = tools_of<PinState>(frame.tools).size(), sutures = tools_of<SutureState>(frame.tools).size();
  if (pins > 0 && rows.button({several(pins, "pin"), "Removes all pins."})) out.commands.emplace_back(Unpin{});
  std::size_t clamps = 0;
  for (const GraspState& grasp : tools_of<GraspState>(frame.tools)) clamps += render::is_clamp(grasp) ? 1 : 0;
  if (clamps > 0 && rows.button({several(clamps, "clamp"), "Removes all clamps, and ends a grasp."}))
    out.commands.emplace_back(Release{std::nullopt});
  if (sutures > 0 && rows.button({several(sutures, "suture"), "Cuts all threads."}))
    out.commands.emplace_back(CutSutures{});
}

void ToolSection::draw_devices(Rows& rows) {
  for (const DeviceInfo& device : devices_) {
    if (device.may_move_view) {
      static const std::vector<std::string> what{"moves instrument", "moves view"};
      int chosen = device_moves_view_ ? 1 : 0;
      if (rows.choice({device.kind, device.name + ". What its translation moves: a second hand, or the view."}, chosen,
                      what))
        device_moves_view_ = chosen == 1;
    } else {
      rows.value({device.kind, device.name + ". A second hand, at the same time as the mouse."},
                 elided(device.name, em(11)));
    }
    const UseFont small(Font::small);
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::ColorConvertU32ToFloat4(colours::muted));
    ImGui::TextWrapped("%s", fmt::format("{}", fmt::join(device.controls, " · ")).c_str());
    ImGui::PopStyleColor();
  }
}

/// A row for a setting that is a length.
void ToolSection::length(Rows& rows, const Label& label, const ToolSetting& setting) {
  double& metres = tool_.*setting.value;
  double millimetres = metres * 1e3;
  if (!rows.slider(label, millimetres, {0, setting.most * body_radius_ * 1e3, "%.1f mm", false})) return;
  metres = std::max(millimetres * 1e-3, setting.least * body_radius_);
}

void ToolSection::draw_settings(Rows& rows) {
  switch (tool_.tool) {
    case Tool::scalpel:
      length(rows, {"Depth", "How far the blade reaches below the surface, mm, along the line of sight."}, depth);
      return;
    case Tool::scissors:
      length(rows, {"Jaw length", "Length of a snip along the jaw line, mm."}, jaw_length);
      length(rows,
             {"Opening",
              "How far the jaws open, mm: the lower one reaches so far below the surface, along the line of "
              "sight, and what is between them is cut."},
             jaw_opening);
      rows.slider({"Direction",
                   "Direction of the jaw line of a click, degrees from the right of the image, "
                   "anticlockwise. A drag snips along its own way."},
                  tool_.jaw_direction, {jaw_direction.least, jaw_direction.most, "%.0f\u00b0", false});
      return;
    case Tool::cautery:
      draw_cautery(rows);
      return;
    case Tool::probe:
      length(rows, {"Tip radius", "Radius of the probe's tip and shaft, mm."}, probe_radius);
      length(rows, {"Indentation", "Depth of the tip below the undeformed surface, mm."}, indentation);
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
             grasp_radius);
  }
}

void ToolSection::draw_cautery(Rows& rows) {
  length(rows,
         {"Burn depth",
          "How far the electrode reaches below the surface, mm, along the line of sight: so deep the "
          "tissue comes apart. 0: it burns the surface and parts nothing."},
         burn_depth);
  length(rows,
         {"Burn radius",
          "How far its heat reaches, mm: tissue up to half as far is coagulated, and less and less up "
          "to the ring."},
         burn_radius);
  double percent = 100 * tool_.shrink;
  if (rows.slider({"Shrink",
                   "Part of their length that coagulated lengths lose, %: 12 to 22 in heated liver, up to "
                   "43 under microwaves."},
                  percent, {0, 100 * shrink.most, "%.0f %%", false}))
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
