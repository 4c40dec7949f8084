#include <algorithm>
#include <app/panel/eye.hpp>
#include <cmath>
#include <numbers>

namespace heml::panel {

void Eye::fit(const View& view, const Skin& skin, render::Size size, const Insets& covered) {
  resize(size, covered);
  const int free = std::max(size.width - static_cast<int>(covered.left + covered.right), size.width / 4);
  centred_ = render::camera_for(view, skin, {free, size.height});
}

void Eye::resize(render::Size size, const Insets& covered) {
  size_ = size;
  covered_ = covered;
}

void Eye::orbit(float right, float down) {
  const float radians = std::numbers::pi_v<float> / static_cast<float>(size_.height);
  centred_.orbit(-right * radians, down * radians);
}

void Eye::pan(float right, float down) {
  const float height = static_cast<float>(size_.height);
  centred_.pan(-right / height, down / height);
}

void Eye::zoom(float notches) { centred_.zoom(std::pow(0.9f, notches)); }

bool Eye::go_to(std::size_t view) {
  if (kept_[view]) centred_ = *kept_[view];
  return has(view);
}

render::Camera Eye::camera() const {
  render::Camera shifted = centred_;
  shifted.pan((covered_.right - covered_.left) / 2 / static_cast<float>(size_.height), 0);
  return shifted;
}

}  // namespace heml::panel
