#include <doctest/doctest.h>

#include <app/window/spacemouse.hpp>

namespace heml::spacemouse_test {

using namespace heml::window;

TEST_CASE("a SpaceMouse's cap moves the hand as it is shifted: right, up, and away from the eye when pushed") {
  CHECK(hand_state(SpaceMouseState{{350, 350, 350, 0, 0, 0}, {}}).move == Vec3f(1, 1, -1));
  CHECK(hand_state(SpaceMouseState{{-350, 0, 0, 0, 0, 0}, {}}).move == Vec3f(-1, 0, 0));
  CHECK(hand_state(SpaceMouseState{{100000, 0, 0, 0, 0, 0}, {}}).move == Vec3f(1, 0, 0));
}

// libspnav's own example turns its cube about (−rx, −ry, rz), y up, z to the eye.
TEST_CASE("a twist of a SpaceMouse's cap turns the view, beyond what comes along with a shift") {
  CHECK(hand_state(SpaceMouseState{{0, 0, 0, 0, -350, 0}, {}}).turn_right == 1);
  CHECK(hand_state(SpaceMouseState{{0, 0, 0, 350, 0, 0}, {}}).turn_down == -1);
  CHECK(hand_state(SpaceMouseState{{20, -20, 20, 60, -60, 350}, {}}).is_idle());
}

TEST_CASE("a SpaceMouse's first button grasps, its second leaves a clamp") {
  CHECK(hand_state(SpaceMouseState{{}, {true, false}}).grasp);
  CHECK_FALSE(hand_state(SpaceMouseState{{}, {true, false}}).clamp);
  CHECK(hand_state(SpaceMouseState{{}, {false, true}}).clamp);
}

}  // namespace heml::spacemouse_test
