#include "app/render/context.hpp"

#include <algorithm>
#include <stdexcept>

namespace heml::render {

void GraphicsContext::load_functions() {
  const int version = gladLoadGL(loader());
  if (version < GLAD_MAKE_VERSION(3, 3)) throw std::runtime_error("OpenGL 3.3 is needed, and this context offers less");
}

Image read_pixels(Size size) {
  Image image(size);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glFinish();
  glReadPixels(0, 0, size.width, size.height, GL_RGB, GL_UNSIGNED_BYTE, image.pixels.data());
  for (int y = 0; y < size.height / 2; ++y)  // OpenGL returns rows bottom-up
    std::swap_ranges(image.at(0, y), image.at(0, y) + std::size_t{3} * size.width, image.at(0, size.height - 1 - y));
  return image;
}

}  // namespace heml::render
