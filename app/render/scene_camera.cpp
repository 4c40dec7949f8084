#include <app/render/scene_camera.hpp>
#include <numbers>

namespace heml::render {

Camera camera_for(const View& view, const BoundingSphere& ball, Size size) {
  constexpr double degree = std::numbers::pi / 180;
  Camera camera;
  camera.fit(ball.centre, ball.radius, size);
  camera.look(static_cast<float>(view.azimuth.value_or(24) * degree),
              static_cast<float>(view.elevation.value_or(20) * degree));
  if (view.zoom) camera.zoom(static_cast<float>(1 / *view.zoom));
  camera.set_orthographic(view.orthographic);
  return camera;
}

}  // namespace heml::render
