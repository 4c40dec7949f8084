#pragma once
// What of the body is shown, and how.
#include <app/panel/actions.hpp>
#include <app/panel/rows.hpp>
#include <app/render/renderer.hpp>
#include <heml/scenario/scene.hpp>

namespace heml::panel {

class ViewSection {
 public:
  explicit ViewSection(const View& view);

  /// Adds the actions of buttons to `pressed`.
  void draw(Rows& rows, std::vector<Action>& pressed, PanelActions& out);

  void show(Field field, PanelActions& out);
  void toggle_wireframe() { drawing_.wireframe = !drawing_.wireframe; }
  void set_range(const render::Range& range) { drawing_.range = range; }
  void set_beyond(std::span<const float> beyond) { drawing_.beyond = beyond; }

  Field field() const { return field_; }
  const render::DrawOptions& drawing() const { return drawing_; }

 private:
  Field field_;
  render::DrawOptions drawing_;
};

}  // namespace heml::panel
