#include <algorithm>
#include <app/render/bounds.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/window/clamps.hpp>

namespace heml::window {
namespace {

constexpr float reach = 9;  // pixels from the drawn clamp

float distance_to_segment(const render::Vec2f& point, const render::Vec2f& from, const render::Vec2f& to) {
  const render::Vec2f along = to - from;
  const float square = along.squaredNorm();
  const float s = square > 0 ? std::clamp((point - from).dot(along) / square, 0.0f, 1.0f) : 0;
  return (point - from - s * along).norm();
}

}  // namespace

std::vector<int> Clamps::in(const Frame& frame) const {
  std::vector<int> there;
  for (const PinState& pin : tools_of<PinState>(frame.tools))
    if (std::find(nodes_.begin(), nodes_.end(), pin.node) != nodes_.end()) there.push_back(pin.node);
  return there;
}

std::optional<int> Clamps::at(const render::Vec2f& pixel, const Frame& frame, const SurfaceMesh& surface_mesh,
                              const panel::CameraController& controller) const {
  std::optional<int> nearest;
  float least = reach;
  if (nodes_.empty()) return nearest;
  const float radius = render::bounding_sphere(uncut_surface(surface_mesh).rest).radius;
  for (const PinState& pin : tools_of<PinState>(frame.tools)) {
    if (std::find(nodes_.begin(), nodes_.end(), pin.node) == nodes_.end()) continue;
    const render::HeldPatch patch = render::held_patch(pin, frame, &surface_mesh, controller.camera().eye());
    const Vec3f end = patch.place + render::clamp_length * radius *
                                        render::handle_axis(patch, controller.camera(), radius);
    const float distance = distance_to_segment(pixel, controller.pixel(patch.place), controller.pixel(end));
    if (!(distance < least)) continue;
    least = distance;
    nearest = pin.node;
  }
  return nearest;
}

}  // namespace heml::window
