#pragma once
// Images in memory.
#include <cstdint>
#include <vector>

namespace heml::render {

/// Pixels.
struct Size {
  int width = 0, height = 0;
  float aspect() const { return height > 0 ? static_cast<float>(width) / static_cast<float>(height) : 1.0f; }
  bool operator==(const Size&) const = default;
};

/// 8-bit sRGB, three bytes per pixel, rows from the top.
struct Image {
  Size size;
  std::vector<std::uint8_t> pixels;  ///< 3·width·height

  Image() = default;
  explicit Image(Size s) : size(s), pixels(std::size_t{3} * s.width * s.height) {}
  std::uint8_t* at(int x, int y) { return &pixels[(std::size_t{3} * y) * size.width + std::size_t{3} * x]; }
  const std::uint8_t* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

/// Root mean square of the differences of all channels, 0 to 255. Throws std::invalid_argument for different sizes.
double rms_difference(const Image& a, const Image& b);

}  // namespace heml::render
