#include <doctest/doctest.h>

#include <app/window/hand_device.hpp>
#include <limits>

namespace heml::hand_device_test {

using namespace heml::window;

TEST_CASE("a deflection counts from the edge of the dead zone, in both directions, and is limited") {
  CHECK(beyond_dead_zone(0, 0.2f) == 0);
  CHECK(beyond_dead_zone(0.2f, 0.2f) == 0);
  CHECK(beyond_dead_zone(-0.19f, 0.2f) == 0);
  CHECK(beyond_dead_zone(0.21f, 0.2f) == doctest::Approx(0.0125));
  CHECK(beyond_dead_zone(0.6f, 0.2f) == doctest::Approx(0.5));
  CHECK(beyond_dead_zone(-0.6f, 0.2f) == doctest::Approx(-0.5));
  CHECK(beyond_dead_zone(1, 0.2f) == 1);
  CHECK(beyond_dead_zone(-7, 0.2f) == -1);
  CHECK(beyond_dead_zone(std::numeric_limits<float>::quiet_NaN(), 0.2f) == 0);
}

TEST_CASE("a state is idle when nothing is deflected or down") {
  CHECK(HandState{}.is_idle());
  CHECK_FALSE(HandState{.move = {0, 0.01f, 0}}.is_idle());
  CHECK_FALSE(HandState{.turn_down = -1}.is_idle());
  CHECK_FALSE(HandState{.grasp = true}.is_idle());
  CHECK_FALSE(HandState{.clamp = true}.is_idle());
}

}  // namespace heml::hand_device_test
