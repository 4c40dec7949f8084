#pragma once
// One interface for OpenGL contexts of a window and in memory, so that pictures are the same in both.
#include <glad/gl.h>

#include <app/render/image.hpp>

namespace heml::render {

/// An OpenGL 3.3 core context and its framebuffer 0. Belongs to one thread at a time.
class GraphicsContext {
 public:
  virtual ~GraphicsContext() = default;

  /// Makes the calling thread draw here.
  virtual void make_current() = 0;

  /// Size of framebuffer 0, pixels.
  virtual Size size() const = 0;

  /// Shows what was drawn; in memory, does nothing.
  virtual void present() = 0;

  /// Looks up OpenGL functions, for load_functions().
  virtual GLADloadfunc loader() const = 0;

 protected:
  /// Constructors call this once the context is current. Throws std::runtime_error below OpenGL 3.3.
  void load_functions();
};

/// The pixels of framebuffer 0 of the current context; waits until drawing has finished.
Image read_pixels(Size size);

}  // namespace heml::render
