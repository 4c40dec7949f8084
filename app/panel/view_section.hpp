#pragma once
// The panel's section "View": field, drawing options, saved views.
#include <app/panel/actions.hpp>
#include <app/panel/camera_controller.hpp>
#include <app/panel/preferences.hpp>
#include <app/panel/rows.hpp>
#include <app/panel/section_control.hpp>
#include <app/render/renderer.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class ViewSection {
 public:
  ViewSection(const View& view, const SurfaceMesh& surface_mesh);

  /// Adds the actions of buttons to `pressed`.
  void draw(Rows& rows, std::vector<Action>& pressed, PanelActions& out);

  void show(Field field, PanelActions& out);
  SectionControl& section() { return section_; }
  const SectionControl& section() const { return section_; }
  void toggle_wireframe() { drawing_.wireframe = !drawing_.wireframe; }
  void set_range(const render::Range& range) { drawing_.range = range; }
  /// Of the colours, in the field's unit; none: it follows the values.
  const std::optional<render::Range>& fixed_range() const { return fixed_; }
  void write_range_into(View& view) const;
  void set_hatched(std::span<const float> excess) { drawing_.hatched = excess; }

  void set_saved(std::size_t view, bool saved) { saved_[view] = saved; }  ///< whether a view is saved
  void set_orthographic(bool on) { orthographic_ = on; }  ///< as the camera is
  bool is_orthographic() const { return orthographic_; }
  void keep(const Preferences& preferences);
  void write_into(Preferences& preferences) const;
  bool hints() const { return hints_; }  ///< whether the hint line is shown

  Field field() const { return field_; }
  render::DrawOptions drawing() const;

 private:
  void draw_range(Rows& rows);
  void draw_views(Rows& rows, std::vector<Action>& pressed) const;

  Field field_;
  std::array<bool, CameraController::views> saved_{};
  SectionControl section_;
  std::optional<render::Range> fixed_;
  float reach_ = 1;  // of its sliders, in the field's unit
  bool hints_ = true, orthographic_ = false;
  render::DrawOptions drawing_;
};

}  // namespace heml::panel
