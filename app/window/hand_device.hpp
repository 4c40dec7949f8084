#pragma once
// Devices beside the mouse that move a hand: each is read once a picture and says what it is made to do then.
//
//    Gamepad ────┐
//                ├─ HandState ──► DeviceHand ──► commands (grasp, move, release of its hand), camera
//    SpaceMouse ─┘
#include <app/panel/actions.hpp>
#include <heml/math/types.hpp>
#include <optional>

namespace heml::window {

/// What a device is made to do. Deflections are 0 within its dead zone and 1 where it goes no further.
struct HandState {
  Vec3f move = Vec3f::Zero();  ///< −1 to 1 each: right, up, towards the eye
  float turn_right = 0, turn_down = 0;  ///< −1 to 1, of the body, as CameraController::orbit() has them
  bool grasp = false, clamp = false;  ///< whether these buttons are down

  bool is_idle() const { return move.isZero(0) && turn_right == 0 && turn_down == 0 && !grasp && !clamp; }
};

class HandDevice {
 public:
  virtual ~HandDevice() = default;
  virtual panel::DeviceInfo info() const = 0;
  /// None: it is no longer there. Never waits.
  virtual std::optional<HandState> read() = 0;
};

/// A deflection of −1 to 1 (further ones are limited) without its dead zone: 0 up to there, then linear to ±1.
float beyond_dead_zone(float deflection, float dead_zone);

}  // namespace heml::window
