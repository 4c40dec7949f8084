// Viewer: arrows of the selection's force and of gravity, and their drag.
#include <fmt/format.h>
#include <imgui.h>

#include <app/panel/condition_edits.hpp>
#include <app/panel/quantity.hpp>
#include <app/panel/theme.hpp>
#include <app/render/bounds.hpp>
#include <app/window/overlay.hpp>
#include <app/window/viewer.hpp>

namespace heml::window {
namespace {

constexpr float force_length = 0.4f, gravity_length = 0.7f;  // of the body's radius
constexpr double usual_force = 0.1, usual_gravity = 9.81;    // N, m/s²: of an arrow that is drawn out from nothing

}  // namespace

/// None: it is not shown. Past frames have none: what is dragged acts on the live body.
std::optional<Arrow> Viewer::arrow_of(ArrowMeaning meaning) const {
  if (playback_.active()) return std::nullopt;
  const float radius = render::bounding_sphere(frame_->surface_mesh->rest).radius;
  if (meaning == ArrowMeaning::gravity) {
    if (!panel_->motion().has_arrow()) return std::nullopt;
    return Arrow{render::bounding_sphere(frame_->positions).centre, panel_->motion().gravity(),
                 gravity_length * radius, usual_gravity};
  }
  if (panel_->tool().tool != panel::Tool::select) return std::nullopt;
  const auto from = middle_of(panel_->selecting().selection().nodes(), *frame_, *frame_->surface_mesh);
  if (!from) return std::nullopt;
  return Arrow{*from, panel_->selecting().force(), force_length * radius, usual_force};
}

/// The one whose tip is under the mouse.
std::optional<Viewer::ArrowMeaning> Viewer::arrow_at_mouse() const {
  const bool free = mouse_tool_.interaction() == MouseTool::Interaction::none && !selection_drag_.is_on();
  if (!free || controller_.current() > 0 || panel_->covers(mouse_.x(), mouse_.y())) return std::nullopt;
  for (const ArrowMeaning meaning : {ArrowMeaning::force, ArrowMeaning::gravity})
    if (const auto arrow = arrow_of(meaning);
        arrow && ArrowDrag::is_on_tip(*arrow, mouse_, panel::em(arrow_handle), controller_))
      return meaning;
  return std::nullopt;
}

bool Viewer::takes_arrow() {
  const auto meaning = arrow_at_mouse();
  if (!meaning) return false;
  arrow_drag_.press(*arrow_of(*meaning));
  dragged_arrow_ = *meaning;
  return true;
}

/// One command, of where the arrow was let go.
void Viewer::end_arrow() {
  const auto value = arrow_drag_.release();
  if (!value) return;
  panel::PanelActions actions;
  if (dragged_arrow_ == ArrowMeaning::gravity) {
    actions.commands.emplace_back(SetGravity{*value});
    panel_->sync(actions.commands.back());
  } else {
    panel_->selecting().set_force(*value);
    actions.commands.emplace_back(
        panel::loaded(*live_->conditions, panel_->selecting().selection().nodes(), *value));
  }
  carry_out(actions);
}

void Viewer::draw_arrows() const {
  const auto at_mouse = arrow_at_mouse();
  for (const ArrowMeaning meaning : {ArrowMeaning::force, ArrowMeaning::gravity}) {
    const auto arrow = arrow_of(meaning);
    if (!arrow) continue;
    const bool dragged = arrow_drag_.is_on() && dragged_arrow_ == meaning;
    const double size = (dragged ? arrow_drag_.value() : arrow->value).norm();
    const std::string text =
        meaning == ArrowMeaning::gravity ? fmt::format("{:.2f} m/s²", size) : panel::quantity(size, "N");
    draw_arrow(arrow->from, dragged ? arrow_drag_.tip() : arrow->tip(), text, panel::colours::accent, controller_);
    draw_arrow_handle(dragged ? arrow_drag_.tip() : arrow->tip(), dragged || at_mouse == meaning, controller_);
  }
}

}  // namespace heml::window
