#pragma once
// The cutting edge of scalpel, scissors and electrode at a pixel.
#include <app/panel/camera_controller.hpp>
#include <array>

namespace heml::window {

inline constexpr float min_stroke = 4;     // pixels of mouse travel per cut
inline constexpr double above_skin = 0.3;  // of the edge, in depths

/// Ends (m) of the edge along the line of sight, from a little above the surface, so that it is cut too, to `depth` (m)
/// below it. anchor: m, of the surface; the edge is as far from the eye.
inline std::array<Vec3, 2> blade_at(const panel::CameraController& controller, const render::Vec2f& at,
                                    const Vec3f& anchor, double depth) {
  const Vec3 point = controller.drag(at, anchor).cast<double>();
  const Vec3 along = controller.ray(at).direction.cast<double>();
  return {point - above_skin * depth * along, point + depth * along};
}

}  // namespace heml::window
