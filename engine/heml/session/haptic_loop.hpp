#pragma once
// Haptic loop: a thread that runs a HapticServo at 1 kHz between a haptic device and the owner of a session. Device
// drivers implement HapticDevice.
//
//    device thread, 1 kHz                     owner of the session, once a frame
//    ────────────────────                     ──────────────────────────────────
//    place() ──► servo ──► push()
//        └────────────────── hand() ────────► post(MoveTool)
//                  ▲──────── show() ◄──────── Frame::tool
//
// Neither thread waits for the other.
#include <heml/tools/haptic_servo.hpp>
#include <memory>

namespace heml {

/// Driver of a device, or a substitute for one. Called only on the loop's thread, at 1 kHz; must not block.
class HapticDevice {
 public:
  virtual ~HapticDevice() = default;
  virtual Vec3 position() = 0;                      ///< m, of the handle, in the body's space
  virtual void apply_force(const Vec3& force) = 0;  ///< N, on the handle, until the next call
};

class HapticLoop {
 public:
  static constexpr double turn = 1e-3;  ///< s, period of the loop

  /// Starts serving the device, which must outlive the loop.
  explicit HapticLoop(HapticDevice& device, const HapticLimits& limits = {});
  ~HapticLoop();  ///< stops the thread and sets the force to zero
  HapticLoop(const HapticLoop&) = delete;
  HapticLoop& operator=(const HapticLoop&) = delete;

  // From one thread, the owner's. None waits.
  void show(const ToolContact& state);  ///< passes on the newest frame's tool while it grasps something
  void let_go();                        ///< tells that the tool grasps nothing: zero force
  Vec3 handle();                        ///< m, newest position of the handle

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml
