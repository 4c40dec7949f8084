#pragma once
// Renders a world headless into PNG files.
#include <app/commands/commands.hpp>
#include <app/panel/comparison_view.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/render/osmesa_context.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/world/world.hpp>

namespace heml {

/// Owns an OpenGL context: use it on the thread that made it.
class FrameCapture {
 public:
  /// Creates the folder. panel: draws the panel; otherwise only a legend, if the scene shows a field. comparisons:
  /// there will be comparison runs, which are labelled. Throws InputError when the folder cannot be created.
  FrameCapture(const Scene& scene, const World& world, ImageSize size, bool panel, bool comparisons,
               std::filesystem::path folder);

  /// Draws the world extrapolated by `ahead` (s) and writes frame_<number>.png. seconds: simulated since the last
  /// frame. comparison_runs: drawn in further panes.
  void capture(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs = nullptr);

  int taken() const { return taken_; }

 private:
  void draw_with_panel(float seconds);
  void draw_alone(float seconds);

  std::filesystem::path folder_;
  render::Size size_;
  render::OsMesaContext context_;
  panel::ComparisonView bodies_;
  std::shared_ptr<const SurfaceMesh> surface_mesh_;  ///< of the last frame
  View view_;
  Frame frame_;
  render::ColourRange colours_;
  std::optional<panel::Interface> interface_;  ///< none if only bodies are drawn
  std::optional<panel::Panel> panel_;
  int taken_ = 0;
};

}  // namespace heml
