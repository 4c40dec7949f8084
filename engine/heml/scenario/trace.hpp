#pragma once
// Tables over time that a scene's `outputs.markers` and `outputs.history` ask for.
#include <filesystem>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>
#include <string>
#include <utility>
#include <vector>

namespace heml {

/// markers.csv   time,marker,x,y,z,vx,vy,vz            one row per marker: mean of its nodes, m and m/s
/// history.csv  time,kinetic,elastic,potential,      J; tool_*: force of the grasp on the tissue, N;
///              min_J,max_J,tool_x,...,               reaction_<k>_*: of boundary[k] on the body, N
///              reaction_0_x,...
class Trace {
 public:
  /// world: of the scene, before its first tick. Throws InputError for a marker that selects no node.
  Trace(const Scene& scene, const World& world);

  /// Call after every tick. Adds rows for the first state at or after each multiple of outputs.every. time: s since the
  /// start, ascending.
  void sample(World& world, double time);

  /// Writes the tables that the scene asks for. Throws InputError when one cannot be written.
  void write(const std::filesystem::path& folder) const;

  static constexpr const char* markers_file = "markers.csv";
  static constexpr const char* history_file = "history.csv";

 private:
  struct Marker {
    std::string name;
    std::vector<int> nodes;
  };
  void sample_markers(const World& world, double time);
  void sample_history(World& world, double time);

  std::vector<Marker> markers_;
  double every_;  ///< s; 0: every tick
  double next_ = 0, last_ = -1;
  std::size_t boundary_entries_ = 0;  // that history_rows_ has columns for
  std::string marker_rows_, history_rows_;
};

}  // namespace heml
