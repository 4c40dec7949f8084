#include <app/window/cautery.hpp>

namespace heml::window {

std::array<Vec3, 2> Cautery::electrode_on(const render::Hit& skin) {
  anchor_ = skin.point;  // follows the relief of the surface
  return blade_at(controller_, at_, skin.point, tool_.burn_depth);
}

void Cautery::burn(Sweep sweep, std::vector<Command>& out) {
  last_ = sweep.blades.back();
  burnt_to_ = at_;
  is_lifted_ = false;
  out.emplace_back(CauterizeTissue{std::move(sweep), {tool_.burn_radius, tool_.shrink}, continues_stroke_});
  continues_stroke_ = true;
}

void Cautery::press(const std::optional<render::Hit>& hit, const render::Vec2f& at, const panel::ToolSettings& tool,
                    std::vector<Command>& out) {
  tool_ = tool;
  at_ = at;
  anchor_.reset();
  continues_stroke_ = false;
  is_lifted_ = !hit;
  if (hit) burn({{electrode_on(*hit)}}, out);
}

void Cautery::drag(const render::Vec2f& at, const std::optional<render::Hit>& hit, std::vector<Command>& out) {
  at_ = at;
  if (!hit) {
    is_lifted_ = true;
    return;
  }
  if (continues_stroke_ && (at - burnt_to_).norm() < min_stroke) return;
  if (is_lifted_)
    burn({{electrode_on(*hit)}}, out);
  else
    burn({{last_, electrode_on(*hit)}}, out);
}

render::StrokeDrawing Cautery::drawing() const {
  render::StrokeDrawing drawing;
  if (anchor_) drawing.electrode = render::Electrode{controller_.drag(at_, *anchor_)};
  return drawing;
}

}  // namespace heml::window
