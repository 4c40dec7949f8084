#pragma once
// The tool in hand and what it is set to; pins, the table and sutures that are there.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>

namespace heml::panel {

class ToolSection {
 public:
  /// body_radius: m, at rest: lengths are scaled by it. gravity: m/s²; a table lies across it.
  ToolSection(double body_radius, const Vec3& gravity);

  void draw(Rows& rows, const Frame& frame, PanelActions& out);
  void select(Tool tool) { tool_.tool = tool; }
  /// Puts a table under the body as it is, or takes all tables away.
  void toggle_table(const Frame& frame, PanelActions& out) const;
  void sync(const SetGravity& command);

  const ToolSettings& tool() const { return tool_; }

 private:
  void draw_settings(Rows& rows);
  void draw_friction(Rows& rows, const Frame& frame, PanelActions& out);
  bool length(Rows& rows, const Label& label, double& metres, double most);

  ToolSettings tool_;
  double body_radius_;
  Vec3 up_ = Vec3::UnitY();
};

}  // namespace heml::panel
