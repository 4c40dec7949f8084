#pragma once
// A body and a headless renderer together: pictures of simulated times.
#include <app/commands/commands.hpp>
#include <app/panel/interface.hpp>
#include <app/panel/panel.hpp>
#include <app/render/osmesa_context.hpp>
#include <app/render/renderer.hpp>
#include <app/render/scene_camera.hpp>
#include <heml/scenario/scene.hpp>
#include <heml/world/world.hpp>

namespace heml {

/// Belongs to the thread that made it.
class Photographer {
 public:
  /// Makes the folder. panel: the window's panel beside the body; without it a legend alone where there is a colour
  /// map. Throws InputError when it cannot.
  Photographer(const Scene& scene, const World& world, PictureSize size, bool panel, std::filesystem::path folder);

  /// Draws the world `ahead` seconds after its present state and writes frame_<number>.png. seconds: since the last
  /// frame.
  void take(World& world, double ahead, double seconds);

  int taken() const { return taken_; }

 private:
  void draw_beside_panel(float seconds);
  void draw_alone(float seconds);

  std::filesystem::path folder_;
  render::Size size_;
  render::OsMesaContext context_;
  render::Renderer renderer_;
  std::shared_ptr<const Skin> skin_;  ///< of the last picture
  View view_;
  Frame frame_;
  render::ColourRange colours_;
  std::optional<panel::Interface> interface_;  ///< none where nothing is written on the picture
  std::optional<panel::Panel> panel_;
  int taken_ = 0;
};

}  // namespace heml
