#pragma once
// A gamepad as GLFW knows it (SDL's layout: letters are those of an Xbox controller).
//
//    left stick: right, up      right stick, up and down: away, towards the eye      pad: turns the view
//    A or right bumper: grasps, lets go      B or left bumper: leaves a clamp
#include <app/window/hand_device.hpp>
#include <array>
#include <memory>

namespace heml::window {

/// Sticks and buttons in GLFW's order; axes are −1 to 1, positive to the right and down.
struct GamepadState {
  std::array<float, 6> axes{};
  std::array<bool, 15> buttons{};
};
HandState hand_state(const GamepadState& pad);

/// The first gamepad that is plugged in; null: none is. Looks for one at the first call and after a joystick has come,
/// else it costs nothing. A window must be open.
std::unique_ptr<HandDevice> find_gamepad();

}  // namespace heml::window
