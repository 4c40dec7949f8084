#pragma once
// A body and a headless renderer together: pictures of simulated times.
#include <app/commands/commands.hpp>
#include <app/panel/comparison_view.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/render/osmesa_context.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/session/comparison_runs.hpp>
#include <heml/world/world.hpp>

namespace heml {

/// Belongs to the thread that made it.
class FrameCapture {
 public:
  /// Makes the folder. panel: the window's panel beside the body; without it a legend alone where there is a colour
  /// map. beside: there will be companions, which are named. Throws InputError when it cannot.
  FrameCapture(const Scene& scene, const World& world, PictureSize size, bool panel, bool comparisons,
               std::filesystem::path folder);

  /// Draws the world `ahead` seconds after its present state and writes frame_<number>.png. seconds: since the last
  /// frame. companions: drawn beside it, if any.
  void capture(World& world, double ahead, double seconds, ComparisonRuns* comparison_runs = nullptr);

  int taken() const { return taken_; }

 private:
  void draw_with_panel(float seconds);
  void draw_alone(float seconds);

  std::filesystem::path folder_;
  render::Size size_;
  render::OsMesaContext context_;
  panel::ComparisonView bodies_;
  std::shared_ptr<const SurfaceMesh> surface_mesh_;  ///< of the last picture
  View view_;
  Frame frame_;
  render::ColourRange colours_;
  std::optional<panel::Interface> interface_;  ///< none where nothing is written on the picture
  std::optional<panel::Panel> panel_;
  int taken_ = 0;
};

}  // namespace heml
