#pragma once
// Clamps: grasps that were left in place. A person grasps with hand 0, the mouse's, and with those of devices
// (device_hand.hpp); what other hands hold is drawn as clamps.
#include <app/panel/camera_controller.hpp>
#include <heml/base/status.hpp>
#include <heml/session/frame.hpp>
#include <heml/world/command.hpp>
#include <optional>

namespace heml::window {

/// The clamp drawn under a pixel; none: there is none.
std::optional<GraspState> clamp_at(const render::Vec2f& pixel, const Frame& frame, const SurfaceMesh& surface_mesh,
                                   const panel::CameraController& controller);

/// A hand for another clamp; none: all are in use.
std::optional<int> free_hand(const Frame& frame);
inline constexpr auto no_free_hand = "There are as many clamps as can be: Del over one removes it.";

/// Why a person's hand may not take what it is about to: it would take it out of another hand of that person.
Status held_by_another(const Grasp& grasp, const Frame& frame);

}  // namespace heml::window
