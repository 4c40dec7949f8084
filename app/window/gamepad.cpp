#define GLFW_INCLUDE_NONE  // glad has the OpenGL functions
#include <GLFW/glfw3.h>

#include <algorithm>
#include <app/window/gamepad.hpp>
#include <utility>

namespace heml::window {
namespace {

constexpr float dead_zone = 0.15f;  // of a stick that rests

bool joysticks_changed = true;  // since they were looked at; on the window's thread

class Gamepad final : public HandDevice {
 public:
  Gamepad(int joystick, std::string name) : joystick_(joystick), name_(std::move(name)) {}
  panel::DeviceInfo info() const override {
    return {"Gamepad", name_,
            {"left stick moves", "right stick: depth", "A grasps, lets go", "B leaves a clamp", "pad turns the view"}};
  }
  std::optional<HandState> read() override {
    GLFWgamepadstate state;
    if (!glfwGetGamepadState(joystick_, &state)) return std::nullopt;
    GamepadState pad;
    std::copy(std::begin(state.axes), std::end(state.axes), pad.axes.begin());
    std::transform(std::begin(state.buttons), std::end(state.buttons), pad.buttons.begin(),
                   [](unsigned char button) { return button == GLFW_PRESS; });
    return hand_state(pad);
  }

 private:
  int joystick_;
  std::string name_;
};

}  // namespace

HandState hand_state(const GamepadState& pad) {
  const auto axis = [&](std::size_t number) { return beyond_dead_zone(pad.axes[number], dead_zone); };
  const auto is_down = [&](std::size_t number) { return pad.buttons[number]; };
  const auto step = [&](std::size_t less, std::size_t more) {
    return static_cast<float>(is_down(more)) - static_cast<float>(is_down(less));
  };
  HandState state;
  state.move = {axis(GLFW_GAMEPAD_AXIS_LEFT_X), -axis(GLFW_GAMEPAD_AXIS_LEFT_Y), axis(GLFW_GAMEPAD_AXIS_RIGHT_Y)};
  state.turn_right = step(GLFW_GAMEPAD_BUTTON_DPAD_LEFT, GLFW_GAMEPAD_BUTTON_DPAD_RIGHT);
  state.turn_down = step(GLFW_GAMEPAD_BUTTON_DPAD_UP, GLFW_GAMEPAD_BUTTON_DPAD_DOWN);
  state.grasp = is_down(GLFW_GAMEPAD_BUTTON_A) || is_down(GLFW_GAMEPAD_BUTTON_RIGHT_BUMPER);
  state.clamp = is_down(GLFW_GAMEPAD_BUTTON_B) || is_down(GLFW_GAMEPAD_BUTTON_LEFT_BUMPER);
  return state;
}

std::unique_ptr<HandDevice> find_gamepad() {
  if (!std::exchange(joysticks_changed, false)) return nullptr;
  glfwSetJoystickCallback([](int, int) { joysticks_changed = true; });
  for (int joystick = GLFW_JOYSTICK_1; joystick <= GLFW_JOYSTICK_LAST; ++joystick)
    if (const char* name = glfwJoystickIsGamepad(joystick) ? glfwGetGamepadName(joystick) : nullptr)
      return std::make_unique<Gamepad>(joystick, name);
  return nullptr;
}

}  // namespace heml::window
