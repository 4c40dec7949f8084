#include <algorithm>
#include <app/window/scissors.hpp>
#include <cmath>
#include <numbers>

namespace heml::window {
namespace {
constexpr int max_snips = 100;  // of one movement of the mouse
}  // namespace

/// From the pointer along the jaws, in the plane that faces the camera, m.
Vec3f Scissors::jaw_line(const panel::ToolSettings& tool) const {
  const auto angle = static_cast<float>(tool.jaw_direction * std::numbers::pi / 180);
  const render::Camera camera = controller_.camera();
  return static_cast<float>(tool.jaw_length) * (std::cos(angle) * camera.right() + std::sin(angle) * camera.up());
}

void Scissors::press(const render::Hit& hit, const render::Vec2f& at, const panel::ToolSettings& tool,
                     const Scene& scene) {
  tool_ = tool;
  anchor_ = hit.point;
  pressed_ = at_ = at;
  blade_ = blade_at(controller_, at, anchor_, tool.jaw_opening);
  is_dragged_ = continues_stroke_ = false;
  line_.clear();
  line_.lift();
  line_.add(hit, scene.frame, scene.surface_mesh);
}

/// Closes the jaws from the end of the last piece to a point (m).
void Scissors::snip(const Vec3f& end, const Scene& scene, std::vector<Command>& out) {
  const render::Vec2f at = controller_.pixel(end);
  const auto hit = render::pick(scene.frame, scene.surface_mesh, controller_.ray(at), scene.section);
  anchor_ = hit ? hit->point : end;  // follows the relief of the surface
  if (hit)
    line_.add(*hit, scene.frame, scene.surface_mesh);
  else
    line_.lift();
  const std::array<Vec3, 2> now = blade_at(controller_, at, anchor_, tool_.jaw_opening);
  out.emplace_back(CutTissue{{{blade_, now}}, continues_stroke_});
  blade_ = now;
  continues_stroke_ = true;
}

void Scissors::drag(const render::Vec2f& at, const Scene& scene, std::vector<Command>& out) {
  at_ = at;
  is_dragged_ = is_dragged_ || (at - pressed_).norm() >= min_stroke;
  if (!is_dragged_) return;
  const auto length = static_cast<float>(tool_.jaw_length);
  for (int k = 0; k < max_snips; ++k) {
    const Vec3f ahead = controller_.drag(at, anchor_) - anchor_;
    if (!(ahead.norm() >= length)) return;
    snip(anchor_ + length / ahead.norm() * ahead, scene, out);
  }
}

void Scissors::release(const Scene& scene, std::vector<Command>& out) {
  if (!is_dragged_) return snip(anchor_ + jaw_line(tool_), scene, out);
  if ((at_ - controller_.pixel(anchor_)).norm() >= min_stroke) snip(controller_.drag(at_, anchor_), scene, out);
}

render::Scissors Scissors::over(const render::Hit& hit, const panel::ToolSettings& tool) const {
  return {hit.point, hit.point + jaw_line(tool), static_cast<float>(tool.jaw_opening), 0};
}

render::StrokeDrawing Scissors::drawing(const Frame& frame, const SurfaceMesh& surface_mesh) const {
  const Vec3f ahead = controller_.drag(at_, anchor_) - anchor_;
  const auto length = static_cast<float>(tool_.jaw_length), gone = ahead.norm();
  const bool follows_drag = is_dragged_ && gone > 0;
  const Vec3f jaws = follows_drag ? Vec3f(length / gone * ahead) : jaw_line(tool_);
  const float closed = follows_drag ? std::min(1.0f, gone / length) : 0;
  return {std::nullopt, line_.segments(frame, surface_mesh),
          render::Scissors{anchor_, anchor_ + jaws, static_cast<float>(tool_.jaw_opening), closed}};
}

}  // namespace heml::window
