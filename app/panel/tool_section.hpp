#pragma once
// The panel's section "Tool": settings of the selected tool (palette.hpp); pins and sutures.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <heml/session/frame.hpp>
#include <map>
#include <string>
#include <vector>

namespace heml::panel {

struct ToolSetting;

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
  void set_tool(const ToolSettings& tool) { tool_ = tool; }
  /// Tells of them from now on.
  void set_devices(std::vector<DeviceInfo> devices) { devices_ = std::move(devices); }
  const std::vector<DeviceInfo>& devices() const { return devices_; }
  void set_device_moves_view(bool on) { device_moves_view_ = on; }
  bool device_moves_view() const { return device_moves_view_; }  ///< those that may, in place of a hand

  /// Settings that differ from the first ones, by name; lengths in radii of the body, so that they suit another body.
  std::map<std::string, double> kept() const;
  /// Takes them; all others become the first ones, those of no use too.
  void keep(const std::map<std::string, double>& kept);

 private:
  void draw_settings(Rows& rows);
  void draw_devices(Rows& rows);
  void draw_cautery(Rows& rows);
  void draw_friction(Rows& rows, const Frame& frame, PanelActions& out);
  void length(Rows& rows, const Label& label, const ToolSetting& setting);

  ToolSettings tool_;
  std::vector<DeviceInfo> devices_;
  bool device_moves_view_ = false;
  double body_radius_;
  Vec3 up_ = Vec3::UnitY();
};

}  // namespace heml::panel
