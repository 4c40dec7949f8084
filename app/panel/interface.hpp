#pragma once
// Dear ImGui with the panel's theme, on OpenGL. A frame: begin(), the panel's draw(), end().
#include <app/render/imgui_renderer.hpp>

namespace heml::panel {

/// Belongs to the OpenGL context that was current when it was made; one at a time.
class Interface {
 public:
  /// scale: 1 for 15 pixels of text.
  explicit Interface(float scale);

  /// The scale that suits a picture: 1 from 1280×720 up, smaller down to 0.72.
  static float suitable_scale(render::Size size);

  /// Between frames. Makes the fonts anew when the scale changes.
  void set_scale(float scale);

  /// size: pixels. seconds: since the last frame.
  void begin(render::Size size, float seconds) { renderer_.begin_frame(size, seconds); }
  /// Draws over framebuffer 0.
  void end() { renderer_.end_frame(); }

 private:
  render::ImguiRenderer renderer_;
  float scale_ = 0;
};

}  // namespace heml::panel
