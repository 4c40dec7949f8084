#pragma once
// Dear ImGui drawn with OpenGL 3.3 core, whoever made the context. (The library's own OpenGL backend opens libGL itself
// and so does not work without a display.)
#include <app/render/gl_objects.hpp>

struct ImGuiContext;

namespace heml::render {

/// Owns the ImGui context and its font. Belongs to the OpenGL context that was current when it was made; one at a time.
class ImguiRenderer {
 public:
  /// scale: size of text and controls; 1 for ordinary screens.
  explicit ImguiRenderer(float scale = 1);
  ~ImguiRenderer();
  ImguiRenderer(const ImguiRenderer&) = delete;
  ImguiRenderer& operator=(const ImguiRenderer&) = delete;

  /// Starts a frame of a size, `seconds` after the one before. A window's input backend is called before this.
  void begin_frame(Size size, float seconds);

  /// Ends the frame and draws it over framebuffer 0.
  void end_frame();

 private:
  void make_font(float scale);

  Program program_{"interface.vert", "interface.frag"};
  VertexArray array_;
  Buffer vertices_, indices_;
  Texture font_;
  ImGuiContext* context_;
};

}  // namespace heml::render
