#pragma once
// Clamps: grasps that were left in place. A person grasps with hand 0; what other hands hold is drawn as clamps.
#include <app/panel/camera_controller.hpp>
#include <heml/session/frame.hpp>
#include <optional>

namespace heml::window {

/// The clamp drawn under a pixel; none: there is none.
std::optional<GraspState> clamp_at(const render::Vec2f& pixel, const Frame& frame, const SurfaceMesh& surface_mesh,
                                   const panel::CameraController& controller);

/// A hand for another clamp; none: all are in use.
std::optional<int> free_hand(const Frame& frame);

}  // namespace heml::window
