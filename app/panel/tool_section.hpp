#pragma once
// The panel's section "Tool": settings of the selected tool (palette.hpp); pins and sutures.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

class ToolSection {
 public:
  /// body_radius: m, at rest; scales the settings. gravity: m/s²; tables are perpendicular to it.
  ToolSection(double body_radius, const Vec3& gravity);

  void draw(Rows& rows, const Frame& frame, PanelActions& out);
  void select(Tool tool) { tool_.tool = tool; }
  /// Adds a table under the lowest point of the body, or removes all tables.
  void toggle_table(const Frame& frame, PanelActions& out) const;
  void sync(const SetGravity& command);

  const ToolSettings& tool() const { return tool_; }

 private:
  void draw_settings(Rows& rows);
  void draw_cautery(Rows& rows);
  void draw_friction(Rows& rows, const Frame& frame, PanelActions& out);
  bool length(Rows& rows, const Label& label, double& metres, double most);

  ToolSettings tool_;
  double body_radius_;
  Vec3 up_ = Vec3::UnitY();
};

}  // namespace heml::panel
