#pragma once
// Exports states of a world for other programs, one file per frame.
#include <filesystem>
#include <heml/mesh/write_vtu.hpp>
#include <heml/world/world.hpp>
#include <string>
#include <vector>

namespace heml {

/// Writes a world's state in the format of the path's extension:
///   .vtu         the present elements, deformed;
///                nodes: displacement (m), velocity (m/s), stretch and von_mises (Pa), averaged by volume;
///                elements: region, the mesh's fields, J, and stress (Cauchy, Pa, 9 numbers; not of springs)
///   .ply, .obj   the surface, deformed; .ply with nodal norm of displacement, stretch, von_mises and volume_ratio
/// Throws InputError when the file cannot be written.
void write_frame(const std::filesystem::path& path, World& world);

class FrameSeries {
 public:
  /// ending: "vtu", "ply" or "obj". Creates the folder. Throws InputError when that fails.
  FrameSeries(std::filesystem::path folder, std::string ending);

  /// Writes frame_<number>.<ending> and, for vtu, frames.pvd with the times of all frames so far. Throws InputError.
  void add_frame(World& world);

  int taken() const { return static_cast<int>(files_.size()); }

 private:
  std::filesystem::path folder_;
  std::string ending_;
  std::vector<SeriesFile> files_;
};

}  // namespace heml
