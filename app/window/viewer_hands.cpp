// Viewer: hands that devices move.
#include <app/window/gamepad.hpp>
#include <app/window/overlay.hpp>
#include <app/window/viewer.hpp>

namespace heml::window {

/// They move hands of the window that has the keys: other programs read them too.
bool Viewer::read_devices() {
  if (!gamepad_.device) gamepad_.device = find_gamepad();
  if (!spacemouse_.device) spacemouse_.device = spacemouse_finder_.take();
  for (PluggedHand* each : {&gamepad_, &spacemouse_}) {
    if (!each->device) continue;
    if (const auto state = each->device->read()) {
      if (each->hand.adopt(window_.focused() ? *state : HandState{})) changed();
      continue;
    }
    std::vector<Command> commands;
    const std::string left = each->hand.unplug(*live_, commands);
    panel_->notify(each->device->info().kind + " is gone" + (left.empty() ? "." : ": " + left));
    post(commands);
    each->device.reset();
    changed();
  }
  return gamepad_.device || spacemouse_.device;
}

/// A hand acts on the body itself, not on its comparison runs; on a past frame it only moves.
void Viewer::move_hands(float seconds) {
  const std::size_t pane = controller_.current();
  controller_.select_pane(0);
  std::vector<Command> commands;
  for (PluggedHand* each : {&gamepad_, &spacemouse_}) {
    if (!each->device) continue;
    const bool moves_view = each->device->info().may_move_view && panel_->device_moves_view();
    if (const Status done = each->hand.act(seconds, moves_view, hand_scene(), commands); !done.ok())
      panel_->notify(done.message());
    if (!playback_.active() || commands.empty()) continue;
    each->hand.let_go(commands);
    commands.clear();
    panel_->notify(past_is_read_only);
  }
  controller_.select_pane(pane);
  post(commands);
  panel_->set_devices(devices());
}

/// Those that have been moved.
std::vector<panel::DeviceInfo> Viewer::devices() const {
  std::vector<panel::DeviceInfo> all;
  for (const PluggedHand* each : {&gamepad_, &spacemouse_}) {
    if (!each->device || !each->hand.has_moved()) continue;
    all.push_back(each->device->info());
    all.back().is_new = each->hand.is_shown() && !each->hand.has_grasped();
  }
  return all;
}

render::HandDrawing Viewer::hands() const {
  render::HandDrawing hands;
  if (const auto hold = mouse_tool_.hold()) hands.holds.push_back(*hold);
  for (const PluggedHand* each : {&gamepad_, &spacemouse_}) {
    if (const auto hold = each->hand.hold()) hands.holds.push_back(*hold);
    if (const auto tip = each->hand.free_tip()) hands.free_tips.push_back(*tip);
  }
  return hands;
}

/// A ring where a hand would take hold.
void Viewer::draw_reach() {
  for (const PluggedHand* each : {&gamepad_, &spacemouse_})
    if (const auto hit = each->hand.in_reach(hand_scene()))
      draw_ring(*hit, *frame_, *frame_->surface_mesh, controller_, panel_->tool().radius);
}

/// Before the body is another, or at another time: hands would pull on it.
void Viewer::release_hands() {
  release_tool();
  std::vector<Command> commands;
  for (PluggedHand* each : {&gamepad_, &spacemouse_}) each->hand.let_go(commands);
  post(commands);
}

}  // namespace heml::window
