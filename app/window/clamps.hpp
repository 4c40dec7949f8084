#pragma once
// Clamps: grasps that were left in place. For the engine each is a pin; which pins were left by the grasper is known
// here alone, so that a replay shows them as pins.
#include <app/panel/camera_controller.hpp>
#include <heml/session/frame.hpp>
#include <optional>
#include <vector>

namespace heml::window {

class Clamps {
 public:
  /// node: mesh-file number of the pin's centre.
  void add(int node) { nodes_.push_back(node); }
  void clear() { nodes_.clear(); }

  /// Centres of those that are still there in a frame, mesh-file numbers.
  std::vector<int> in(const Frame& frame) const;
  /// The clamp drawn under a pixel; none: there is none.
  std::optional<int> at(const render::Vec2f& pixel, const Frame& frame, const SurfaceMesh& surface_mesh,
                        const panel::CameraController& controller) const;

 private:
  std::vector<int> nodes_;
};

}  // namespace heml::window
