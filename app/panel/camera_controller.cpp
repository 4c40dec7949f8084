#include <algorithm>
#include <app/panel/camera_controller.hpp>
#include <cmath>
#include <numbers>

namespace heml::panel {

bool Pane::contains(const render::Vec2f& at) const {
  const float x = at.x() - static_cast<float>(left), y = at.y() - static_cast<float>(top);
  return x >= 0 && y >= 0 && x < static_cast<float>(size.width) && y < static_cast<float>(size.height);
}

std::vector<Pane> make_panes(render::Size picture, const Insets& covered, std::size_t count) {
  const int columns = count == 4 ? 2 : static_cast<int>(count), rows = count == 4 ? 2 : 1;
  const float free = static_cast<float>(picture.width) - covered.left - covered.right;
  const auto edge = [&](int column) {
    if (column == 0) return 0;
    if (column == columns) return picture.width;
    return static_cast<int>(covered.left + free * static_cast<float>(column) / static_cast<float>(columns));
  };
  std::vector<Pane> panes;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      panes.push_back({edge(column),
                       picture.height * row / rows,
                       {edge(column + 1) - edge(column), picture.height / rows},
                       {column == 0 ? covered.left : 0, column + 1 == columns ? covered.right : 0}});
  return panes;
}

void CameraController::fit(const View& view, const render::BoundingSphere& ball, render::Size size,
                           const Insets& covered, std::size_t bodies) {
  resize(size, covered, bodies);
  const Pane& first = panes_.front();
  const int free = first.size.width - static_cast<int>(first.covered.left + first.covered.right);
  centred_ = render::camera_for(view, ball, {std::max(free, first.size.width / 4), first.size.height});
}

void CameraController::resize(render::Size size, const Insets& covered, std::size_t bodies) {
  size_ = size;
  panes_ = make_panes(size, covered, bodies);
  current_ = std::min(current_, panes_.size() - 1);
}

void CameraController::select_pane_at(const render::Vec2f& at) {
  for (std::size_t k = 0; k < panes_.size(); ++k)
    if (panes_[k].contains(at)) current_ = k;
}

void CameraController::orbit(float right, float down, const std::optional<Vec3f>& pivot) {
  const float radians = std::numbers::pi_v<float> / static_cast<float>(pane().size.height);
  if (!pivot) return centred_.orbit(-right * radians, down * radians);
  centred_.orbit(-right * radians, down * radians, *pivot);
}

void CameraController::look(StandardView view) {
  constexpr double degree = std::numbers::pi / 180;
  const ViewAngles angles = angles_of(view);
  centred_.look(static_cast<float>(angles.azimuth * degree), static_cast<float>(angles.elevation * degree));
}

void CameraController::pan(float right, float down) {
  const float height = static_cast<float>(pane().size.height);
  centred_.pan(-right / height, down / height);
}

void CameraController::zoom(float notches) { centred_.zoom(std::pow(0.9f, notches)); }

bool CameraController::restore_view(std::size_t view) {
  if (saved_[view]) centred_ = render::Camera(*saved_[view]);
  return has_view(view);
}

render::Camera CameraController::camera() const {
  render::Camera shifted = centred_;
  const Insets& covered = pane().covered;
  shifted.pan((covered.right - covered.left) / 2 / static_cast<float>(pane().size.height), 0);
  return shifted;
}

render::Ray CameraController::ray(const render::Vec2f& at) const {
  const render::Vec2f inside = at - corner();
  return camera().ray(inside.x(), inside.y(), pane().size);
}

Vec3f CameraController::drag(const render::Vec2f& at, const Vec3f& point) const {
  const render::Vec2f inside = at - corner();
  return camera().drag(inside.x(), inside.y(), pane().size, point);
}

render::Vec2f CameraController::pixel(const Vec3f& point) const {
  return camera().pixel(point, pane().size) + corner();
}

}  // namespace heml::panel
