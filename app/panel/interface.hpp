#pragma once
// Dear ImGui with the panel's theme, on OpenGL. A frame: begin(), the panel's draw(), end().
#include <app/panel/theme.hpp>
#include <app/render/imgui_renderer.hpp>

namespace heml::panel {

/// Owns objects of the OpenGL context that is current in the constructor. At most one exists at a time.
class Interface {
 public:
  /// scale: 1 for 15 pixels of text.
  explicit Interface(float scale, Theme theme = Theme::dark);

  /// The scale for an image of a size: 1 from 1280×720 up, down to 0.72 for smaller ones.
  static float suitable_scale(render::Size size);

  /// Rebuilds the fonts if scale or theme change or texts need further letters. Call between frames.
  void set_look(float scale, Theme theme);

  /// size: pixels. seconds: since the last frame.
  void begin(render::Size size, float seconds) { renderer_.begin_frame(size, seconds); }
  /// Draws over framebuffer 0. opacity: of the panel, 0 to 1.
  void end(float opacity = 1) { renderer_.end_frame(opacity); }

 private:
  render::ImguiRenderer renderer_;
  float scale_ = 0;
  Theme theme_ = Theme::dark;
};

}  // namespace heml::panel
