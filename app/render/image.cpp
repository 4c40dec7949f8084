#include "app/render/image.hpp"

#include <cmath>
#include <stdexcept>

namespace heml::render {

double rms_difference(const Image& a, const Image& b) {
  if (!(a.size == b.size)) throw std::invalid_argument("rms_difference: images of different sizes");
  if (a.pixels.empty()) return 0;
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const double difference = static_cast<double>(a.pixels[i]) - b.pixels[i];
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

}  // namespace heml::render
