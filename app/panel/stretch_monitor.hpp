#pragma once
// Where the surface is stretched beyond what a tissue's numbers were measured in. Looks at the largest principal
// stretch at nodes: in tissue that keeps its volume a compression shows in it too, as the stretch across.
#include <heml/session/frame.hpp>
#include <heml/world/setup.hpp>
#include <limits>
#include <span>
#include <vector>

namespace heml::panel {

class StretchMonitor {
 public:
  explicit StretchMonitor(const SurfaceMesh& surface_mesh);

  /// Takes the limits of each region from the presets its material has.
  void set(std::span<const RegionMaterial> materials);

  /// Whether any part of the surface has a limit: frames should then carry stretches.
  bool active() const { return active_; }

  /// Takes a frame's stretches, if it carries them.
  void update(const Frame& frame);

  std::span<const float> beyond() const { return beyond_; }  ///< #S, stretch above its limit; empty unless active
  double share() const { return share_; }                    ///< of the nodes with a limit that are beyond it, 0 to 1

 private:
  static constexpr float no_limit = std::numeric_limits<float>::max();

  std::vector<std::vector<int>> regions_of_node_;  ///< #S
  std::vector<float> limit_;                       ///< #S
  std::vector<float> beyond_;
  double share_ = 0;
  bool active_ = false;
};

}  // namespace heml::panel
