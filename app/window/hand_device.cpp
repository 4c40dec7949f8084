#include <algorithm>
#include <app/window/hand_device.hpp>
#include <cmath>

namespace heml::window {

float beyond_dead_zone(float deflection, float dead_zone) {
  const float size = std::min(std::abs(deflection), 1.0f);
  if (!(size > dead_zone)) return 0;  // not a number either
  return std::copysign((size - dead_zone) / (1 - dead_zone), deflection);
}

}  // namespace heml::window
