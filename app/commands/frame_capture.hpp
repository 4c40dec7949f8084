#pragma once
// Renders a world headless into PNG files.
#include <app/commands/commands.hpp>
#include <app/panel/frame_drawing.hpp>

namespace heml {

/// Owns an OpenGL context: use it on the thread that made it.
class FrameCapture {
 public:
  /// Creates the folder; throws InputError when it cannot. panel, comparisons: as of FrameDrawing.
  FrameCapture(const Scene& scene, const World& world, ImageSize size, bool panel, bool comparisons,
               std::filesystem::path folder);

  /// Draws the world as FrameDrawing does and writes frame_<number>.png.
  void capture(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs = nullptr);

  int taken() const { return taken_; }

 private:
  std::filesystem::path folder_;
  panel::FrameDrawing drawing_;
  int taken_ = 0;
};

}  // namespace heml
