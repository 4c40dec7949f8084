#include <app/window/cautery.hpp>

namespace heml::window {

/// As the scalpel's edge; without depth it is its tip alone, on the skin.
std::array<Vec3, 2> Cautery::electrode_at(const render::Vec2f& at) const {
  return blade_at(controller_, at, anchor_, tool_.burn_depth);
}

void Cautery::burn(Sweep sweep, std::vector<Command>& out) {
  last_ = sweep.blades.back();
  burnt_to_ = at_;
  is_lifted_ = false;
  out.emplace_back(CauterizeTissue{std::move(sweep), {tool_.burn_radius, tool_.shrink}, continues_stroke_});
  continues_stroke_ = true;
}

void Cautery::press(const render::Hit& hit, const render::Vec2f& at, const panel::ToolSettings& tool,
                    std::vector<Command>& out) {
  tool_ = tool;
  at_ = at;
  anchor_ = hit.point;
  continues_stroke_ = false;
  burn({{electrode_at(at)}}, out);
}

void Cautery::drag(const render::Vec2f& at, const std::optional<render::Hit>& hit, std::vector<Command>& out) {
  at_ = at;
  if (!hit) {
    is_lifted_ = true;
    return;
  }
  if ((at - burnt_to_).norm() < min_stroke) return;
  anchor_ = hit->point;  // follows the relief of the surface
  if (is_lifted_)
    burn({{electrode_at(at)}}, out);
  else
    burn({{last_, electrode_at(at)}}, out);
}

render::StrokeDrawing Cautery::drawing() const {
  render::StrokeDrawing drawing;
  drawing.electrode = render::Electrode{controller_.drag(at_, anchor_)};
  return drawing;
}

}  // namespace heml::window
