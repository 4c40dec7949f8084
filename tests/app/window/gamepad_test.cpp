#include <doctest/doctest.h>

#include <app/window/gamepad.hpp>

namespace heml::gamepad_test {

using namespace heml::window;

TEST_CASE("a gamepad's left stick moves the hand in the image, the right stick in depth") {
  GamepadState pad;
  pad.axes = {1, -1, 0, -1, -1, -1};  // right and up; away; triggers rest at −1
  HandState state = hand_state(pad);
  CHECK(state.move == Vec3f(1, 1, -1));
  pad.axes = {-1, 1, 1, 1, 1, 1};  // the right stick's way to the side has no meaning
  state = hand_state(pad);
  CHECK(state.move == Vec3f(-1, -1, 1));
  CHECK(state.turn_right == 0);
  CHECK_FALSE(state.grasp);
}

TEST_CASE("sticks of a gamepad that rest a little off their middle move nothing") {
  GamepadState pad;
  pad.axes = {0.12f, -0.14f, 0.1f, 0.13f, -1, -1};
  CHECK(hand_state(pad).is_idle());
}

TEST_CASE("a gamepad's pad turns the view, A and B and the bumpers grasp and leave clamps") {
  GamepadState pad;
  pad.buttons[14] = true;  // GLFW: pad to the left
  CHECK(hand_state(pad).turn_right == -1);
  pad.buttons = {};
  pad.buttons[12] = pad.buttons[13] = true;  // right and down
  CHECK(hand_state(pad).turn_right == 1);
  CHECK(hand_state(pad).turn_down == 1);
  for (const std::size_t grasps : {0, 5}) {
    pad.buttons = {};
    pad.buttons[grasps] = true;
    CHECK(hand_state(pad).grasp);
    CHECK_FALSE(hand_state(pad).clamp);
  }
  for (const std::size_t leaves : {1, 4}) {
    pad.buttons = {};
    pad.buttons[leaves] = true;
    CHECK(hand_state(pad).clamp);
    CHECK_FALSE(hand_state(pad).grasp);
  }
}

}  // namespace heml::gamepad_test
