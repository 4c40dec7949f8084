#pragma once
// Finds where the surface is stretched beyond the range in which a tissue's parameters were measured. Compares the
// largest principal stretch at nodes, which in nearly incompressible tissue also shows a compression, as lateral
// stretch.
#include <heml/session/frame.hpp>
#include <heml/world/setup.hpp>
#include <limits>
#include <span>
#include <vector>

namespace heml::panel {

class StretchMonitor {
 public:
  explicit StretchMonitor(const SurfaceMesh& surface_mesh);

  /// Sets the limits of each region from the preset of its material.
  void set(std::span<const RegionMaterial> materials);

  /// Whether any node has a limit; frames must then carry stretches.
  bool active() const { return active_; }

  /// Compares a frame's stretches with the limits; without stretches no node is beyond.
  void update(const Frame& frame);

  std::span<const float> beyond() const { return beyond_; }  ///< #S, stretch above its limit; empty unless active
  double share() const { return share_; }                    ///< of nodes beyond among those with a limit, 0 to 1

 private:
  static constexpr float no_limit = std::numeric_limits<float>::max();

  std::vector<std::vector<int>> regions_of_node_;  ///< #S
  std::vector<float> limit_;                       ///< #S
  std::vector<float> beyond_;
  double share_ = 0;
  bool active_ = false;
};

}  // namespace heml::panel
