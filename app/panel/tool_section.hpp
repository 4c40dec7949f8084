#pragma once
// The panel's section "Tool": settings of the selected tool (palette.hpp); pins and sutures.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>
#include <map>
#include <string>

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

  /// Settings that differ from the first ones, by name; lengths in radii of the body, so that they suit another body.
  std::map<std::string, double> kept() const;
  /// Takes them; all others become the first ones, those of no use too.
  void keep(const std::map<std::string, double>& kept);

 private:
  void draw_settings(Rows& rows);
  void draw_friction(Rows& rows, const Frame& frame, PanelActions& out);

  ToolSettings tool_;
  double body_radius_;
  Vec3 up_ = Vec3::UnitY();
};

}  // namespace heml::panel
