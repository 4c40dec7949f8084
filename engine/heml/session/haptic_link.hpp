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
  virtual Vec3 place() = 0;                  ///< m, of the hand, in the body's space
  virtual void push(const Vec3& force) = 0;  ///< N, on the hand, until the next call
};

class HapticLink {
 public:
  static constexpr double turn = 1e-3;  ///< s

  /// Serves the device, which must live longer, from now on.
  explicit HapticLink(HapticDevice& device, const HapticLimits& limits = {});
  ~HapticLink();  ///< the last force is none
  HapticLink(const HapticLink&) = delete;
  HapticLink& operator=(const HapticLink&) = delete;

  // From one thread, the driver's.
  void show(const TouchState& state);  ///< what the newest frame has, while the tool holds something
  void let_go();                       ///< it does not
  Vec3 hand();                         ///< m, the newest place

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace heml
