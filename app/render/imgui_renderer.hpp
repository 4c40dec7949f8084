#pragma once
// Draws Dear ImGui with OpenGL 3.3 core in any context. (The library's own OpenGL backend opens libGL itself, so it
// does not work without a display.)
#include <app/render/gl_objects.hpp>

struct ImGuiContext;

namespace heml::render {

/// Owns the ImGui context and its font. Bound to the OpenGL context that is current at construction; one at a time.
class ImguiRenderer {
 public:
  /// scale: of text and controls; 1 for ordinary screens.
  explicit ImguiRenderer(float scale = 1);
  ~ImguiRenderer();
  ImguiRenderer(const ImguiRenderer&) = delete;
  ImguiRenderer& operator=(const ImguiRenderer&) = delete;

  /// Starts a frame, `seconds` after the previous one. Call the window's input backend first.
  void begin_frame(Size size, float seconds);

  /// Ends the frame and draws it over framebuffer 0. opacity: of the windows, 0 to 1; marks on the image keep theirs.
  void end_frame(float opacity = 1);

 private:
  void make_font(float scale);

  Program program_{"interface.vert", "interface.frag"};
  VertexArray array_;
  Buffer vertices_, indices_;
  Texture font_;
  ImGuiContext* context_;
};

}  // namespace heml::render
