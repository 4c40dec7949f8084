#pragma once
// Where OpenGL draws: a window, or memory. One interface for both, so that pictures do not depend on which it is.
#include <glad/gl.h>

#include <app/render/image.hpp>

namespace heml::render {

/// An OpenGL 3.3 core context and its framebuffer 0. Belongs to one thread at a time.
class GraphicsContext {
 public:
  virtual ~GraphicsContext() = default;

  /// Makes the calling thread draw here.
  virtual void make_current() = 0;

  /// Of framebuffer 0, pixels.
  virtual Size size() const = 0;

  /// Shows what was drawn, where there is someone to show it to.
  virtual void present() = 0;

  /// Finds OpenGL functions; for load_functions().
  virtual GLADloadfunc loader() const = 0;

 protected:
  /// To be called by constructors once the context is current. Throws std::runtime_error below OpenGL 3.3.
  void load_functions();
};

/// What framebuffer 0 of the current context shows, once drawing has finished.
Image read_pixels(Size size);

}  // namespace heml::render
