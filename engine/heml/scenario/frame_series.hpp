#pragma once
// A motion as files for other programs, one a frame.
#include <filesystem>
#include <heml/mesh/write_vtu.hpp>
#include <heml/world/world.hpp>
#include <string>
#include <vector>

namespace heml {

/// Writes a world's state as `heml solve` and series have it, by the path's ending:
///   .vtu         the elements that are there, deformed; of nodes displacement (m), velocity (m/s), stretch and
///   von_mises
///                (Pa, averaged by volume); of elements region, what fields the mesh has, J, and
///                stress (Cauchy, Pa, nine numbers, not of springs)
///   .ply, .obj   the surface, deformed; .ply with displacement's size, stretch, von_mises and volume_ratio of its
///   nodes
/// Throws InputError when it cannot be written.
void write_frame(const std::filesystem::path& path, World& world);

class FrameSeries {
 public:
  /// ending: of write_frame(). Makes the folder. Throws InputError when it cannot.
  FrameSeries(std::filesystem::path folder, std::string ending);

  /// Writes frame_<number>.<ending> and, of .vtu, frames.pvd with the times of all frames so far.
  void add_frame(World& world);

  int taken() const { return static_cast<int>(files_.size()); }

 private:
  std::filesystem::path folder_;
  std::string ending_;
  std::vector<SeriesFile> files_;
};

}  // namespace heml
