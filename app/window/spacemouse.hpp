#pragma once
// A SpaceMouse or another 6-degree device, by the daemon spacenavd and the library libspnav, which are opened when a
// window is, if they are there. Where the library's header was missing at build time there is no such device.
//
//    cap: right, up, away   button 0: grasps, lets go   button 1: leaves a clamp   a twist of the cap: turns the view
#include <app/window/hand_device.hpp>
#include <array>
#include <memory>

namespace heml::window {

/// What the daemon told last. Axes in its units: x right, y up, z away from the person; rotations about them.
struct SpaceMouseState {
  std::array<int, 6> axes{};
  std::array<bool, 2> buttons{};
};
HandState hand_state(const SpaceMouseState& mouse);

/// Looks for the daemon: once, in a thread of its own, since the library waits for the daemon's answer.
class SpaceMouseFinder {
 public:
  SpaceMouseFinder();
  /// The device, once; null: not found (yet).
  std::unique_ptr<HandDevice> take();

 private:
  struct Search;
  std::shared_ptr<Search> search_;
};

}  // namespace heml::window
