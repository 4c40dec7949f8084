// Viewer: applies mouse and keyboard input in its order.
#include <imgui.h>

#include <app/panel/keys.hpp>
#include <app/window/viewer.hpp>
#include <utility>

namespace heml::window {
namespace {
constexpr auto double_click_time = std::chrono::milliseconds(350);
constexpr float double_click_distance = 6;  // pixels
constexpr int first_unprinted = 256;        // of GLFW's codes of keys: Escape, Enter, arrows ...
}  // namespace

void Viewer::came(Input input) {
  input_.add(std::move(input));
  changed();
}

void Viewer::apply_input() {
  input_.apply([this](const Input& input) {
    changed();
    const bool is_of_action = std::holds_alternative<CharacterInput>(input) && std::exchange(key_acted_, false);
    if (!is_of_action) window_.pass_to_imgui(input);
    return std::visit([this](const auto& one) { return apply(one); }, input);
  });
}

/// A text field sees a key that is not a letter when it is held in a picture.
int Viewer::apply(const KeyInput& key) {
  const bool is_typing = ImGui::GetIO().WantTextInput, was_modal = panel_->is_modal();
  const bool is_seen_held = is_typing && !key.repeated && (key.code >= first_unprinted || key.control);
  const auto action = panel::action_of(key.key, key.control, key.shift);
  if (key.down) last_key_ = key.key;
  if (key.down) key_acted_ = false;
  if (!key.down || !action) return is_seen_held;
  using enum panel::Action;
  const bool chooses = *action == select_previous || *action == select_next;
  const bool is_asked =
      panel_->asks() || (panel_->is_modal() && (chooses || *action == open_selected || *action == release));
  const bool may_repeat = chooses || *action == step || *action == seek_previous || *action == seek_next;
  const bool is_text = is_typing && !is_asked && *action != quit;
  if (is_text || (key.repeated && !may_repeat)) return is_seen_held;
  key_acted_ = true;
  perform(*action);
  if (panel_->is_modal() != was_modal) return settling_frames;  // until a text field has the keys
  return is_seen_held || was_modal;
}

void Viewer::perform(panel::Action action) {
  if (action == panel::Action::quit) return ask_to_quit();  // the panel may be busy with a dialog
  panel_->perform(action);
  carry_out(panel_->perform_now(*frame_));
}

/// Whether a button went down on the panel, or takes an active control of it away.
bool Viewer::panel_takes(const ButtonInput& button) {
  bool& has = panel_has_[static_cast<std::size_t>(button.button)];
  if (button.down)
    has = panel_->covers(mouse_.x(), mouse_.y()) || ImGui::IsAnyItemActive() || ImGui::GetIO().WantTextInput;
  return has;
}

int Viewer::apply(const ButtonInput& button) {
  const int pictures = panel_takes(button);
  if (button.down) {
    if (!panel_->covers(mouse_.x(), mouse_.y())) press(button);
    return pictures;
  }
  if (button.button == MouseButton::left) {
    drags_section_ = false;
    end_selection();
    end_arrow();
  }
  std::vector<Command> commands;
  mouse_tool_.release(button.button, seen(), *seen().surface_mesh, commands);
  post(commands);
  return pictures;
}

/// A button went down off the panel.
void Viewer::press(const ButtonInput& input) {
  const MouseButton button = input.button;
  if (button == MouseButton::left && is_on_section_handle()) {
    drags_section_ = true;
    return;
  }
  if (button == MouseButton::left && takes_arrow()) return;
  if (button == MouseButton::left && (measures_at_mouse() || selects_at_mouse(input))) return;
  if (playback_.active() && button == MouseButton::left && mouse_tool_.pick(mouse_, seen(), *seen().surface_mesh))
    panel_->notify(past_is_read_only);
  const bool has_other_surface = controller_.current() > 0 && !seen().distance;  // with other node numbers
  if (playback_.active() || has_other_surface)
    return mouse_tool_.press_background(button, mouse_, input.shift, seen(), *seen().surface_mesh);
  std::vector<Command> commands;
  if (const Status pressed = mouse_tool_.press(button, mouse_, input.shift, seen(), *seen().surface_mesh,
                                               panel_->tool(), commands);
      !pressed.ok())
    panel_->notify(pressed.message());
  post(commands);
  if (button != MouseButton::left || !mouse_tool_.is_beside_body()) return;
  const auto now = std::chrono::steady_clock::now();
  const bool twice = now - pressed_at_ < double_click_time && (mouse_ - pressed_where_).norm() < double_click_distance;
  pressed_at_ = twice ? std::chrono::steady_clock::time_point{} : now;
  pressed_where_ = mouse_;
  if (twice) perform(panel::Action::fit);
}

/// Sets a point of the measure at the mouse; the timeline's past can be measured too. False: there is nothing to set.
bool Viewer::measures_at_mouse() {
  if (panel_->tool().tool != panel::Tool::measure || mouse_tool_.interaction() != MouseTool::Interaction::none)
    return false;
  const auto hit = mouse_tool_.pick(mouse_, seen(), *seen().surface_mesh);
  if (!hit) return false;
  if (controller_.current() > 0)
    panel_->notify("The body itself is measured, not its comparison runs.");
  else
    panel_->measure().add(render::surface_point(*hit, seen(), *seen().surface_mesh));
  return true;
}

/// Begins a selection; the timeline's past can be selected of too. False: another tool is chosen.
bool Viewer::selects_at_mouse(const ButtonInput& input) {
  if (panel_->tool().tool != panel::Tool::select || mouse_tool_.interaction() != MouseTool::Interaction::none)
    return false;
  if (controller_.current() > 0) {
    panel_->notify("Nodes of the body itself are selected, not of its comparison runs.");
    return true;
  }
  using How = panel::NodeSelection::How;
  const panel::SelectionSection& section = panel_->selecting();
  selection_drag_.press(mouse_,
                        {section.drag(), section.through(), panel_->tool().radius,
                         input.shift     ? How::add
                         : input.control ? How::remove
                                         : How::replace},
                        selection_view());
  return true;
}

void Viewer::end_selection() {
  if (!selection_drag_.is_on()) return;
  const SelectionDrag::Nodes nodes = selection_drag_.release(selection_view());
  panel_->selecting().selection().take(nodes.surface, selection_drag_.how());
  panel_->selecting().inside().take(nodes.inside, selection_drag_.how());
}

/// The arrow, the drag, or else the nodes.
void Viewer::forget_selection() {
  if (arrow_drag_.is_on()) return arrow_drag_.cancel();
  if (selection_drag_.is_on()) return selection_drag_.cancel();
  if (panel_->tool().tool == panel::Tool::select) panel_->selecting().forget();
}

int Viewer::apply(const MotionInput& motion) {
  if (drags_section_) panel_->view().section().drag(mouse_, motion.at, controller_);
  mouse_ = motion.at;
  if (drags_section_) return 0;
  if (selection_drag_.is_on()) {
    selection_drag_.move(mouse_, selection_view());
    return 0;
  }
  if (arrow_drag_.is_on()) {
    arrow_drag_.move(mouse_, ImGui::GetIO().KeyShift, controller_);
    return 0;
  }
  if (mouse_tool_.interaction() == MouseTool::Interaction::none) controller_.select_pane_at(mouse_);
  std::vector<Command> commands;
  mouse_tool_.move(mouse_, seen(), *seen().surface_mesh, commands);
  post(commands);
  return 0;
}

int Viewer::apply(const WheelInput& wheel) {
  std::vector<Command> commands;
  if (mouse_tool_.wheel(wheel.notches, commands)) {
    post(commands);
    return 0;
  }
  if (panel_->covers(mouse_.x(), mouse_.y())) return 1;
  controller_.zoom(wheel.notches);
  return 0;
}

int Viewer::apply(const DropInput& drop) {
  open(drop.path);
  return 0;
}

}  // namespace heml::window
