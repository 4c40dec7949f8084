#include <algorithm>
#include <app/render/bounds.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/window/clamps.hpp>

namespace heml::window {
namespace {

constexpr float clamp_reach = 9;  // pixels from the drawn clamp

float distance_to_segment(const render::Vec2f& point, const render::Vec2f& from, const render::Vec2f& to) {
  const render::Vec2f along = to - from;
  const float square = along.squaredNorm();
  const float s = square > 0 ? std::clamp((point - from).dot(along) / square, 0.0f, 1.0f) : 0;
  return (point - from - s * along).norm();
}

}  // namespace

std::optional<GraspState> clamp_at(const render::Vec2f& pixel, const Frame& frame, const SurfaceMesh& surface_mesh,
                                   const panel::CameraController& controller) {
  std::optional<GraspState> nearest;
  float least = clamp_reach, radius = 0;
  for (const GraspState& grasp : tools_of<GraspState>(frame.tools)) {
    if (!render::is_clamp(grasp)) continue;
    if (radius == 0) radius = render::bounding_sphere(uncut_surface(surface_mesh).rest).radius;
    const render::HeldPatch patch =
        render::held_patch(grasp, std::nullopt, frame, &surface_mesh, controller.camera().eye());
    const Vec3f end = patch.place + render::clamp_length * radius *
                                        render::handle_axis(patch, controller.camera(), radius);
    const float distance = distance_to_segment(pixel, controller.pixel(patch.place), controller.pixel(end));
    if (!(distance < least)) continue;
    least = distance;
    nearest = grasp;
  }
  return nearest;
}

std::optional<int> free_hand(const Frame& frame) {
  for (int hand = 1; hand < first_device_hand; ++hand)
    if (!find_grasp(frame.tools, hand)) return hand;
  return std::nullopt;
}

Status held_by_another(const Grasp& grasp, const Frame& frame) {
  for (const GraspState& held : tools_of<GraspState>(frame.tools))
    if (is_persons_hand(held.hand) && held.hand != grasp.hand && held.node == grasp.node && held.radius == grasp.radius)
      return "Your other hand holds this tissue: take hold beside it.";
  return {};
}

}  // namespace heml::window
