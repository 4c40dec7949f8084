#pragma once
// A hand on a device, and the servo between it and whoever drives a session: the place where a driver is plugged in.
//
//    device thread, 1 kHz                     the session's driver, once a frame
//    ────────────────────                     ──────────────────────────────────
//    place() ──► servo ──► push()
//        └────────────────── hand() ────────► post(MoveTool)
//                  ▲──────── show() ◄──────── Frame::tool
//
// Neither waits for the other.
#include <heml/tools/haptic_servo.hpp>
#include <memory>

namespace heml {

/// A driver of a device, or what stands for one. Called on the link's thread alone, a thousand times a second; must not
/// wait for long.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual Vec3 position() = 0;                      ///< m, of the hand, in the body's space
  virtual void apply_force(const Vec3& force) = 0;  ///< N, on the hand, until the next call
};

class HapticLoop {
 public:
  static constexpr double turn = 1e-3;  ///< s

  /// Serves the device, which must live longer, from now on.
  explicit HapticLoop(HapticDevice& device, const HapticLimits& limits = {});
  ~HapticLoop();  ///< the last force is none
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  // From one thread, the driver's.
  void show(const ToolContact& state);  ///< what the newest frame has, while the tool holds something
  void let_go();                        ///< it does not
  Vec3 handle();                        ///< m, the newest place

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml
