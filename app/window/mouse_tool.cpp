#include <algorithm>
#include <app/window/elements_around.hpp>
#include <app/window/free_nodes.hpp>
#include <app/window/mouse_tool.hpp>

namespace heml::window {
std::optional<render::Hit> MouseTool::pick(const render::Vec2f& at, const Frame& frame,
                                           const SurfaceMesh& surface_mesh) const {
  return render::pick(frame, surface_mesh, controller_.ray(at), section_);
}

Status MouseTool::press(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame,
                        const SurfaceMesh& surface_mesh, const panel::ToolSettings& tool, std::vector<Command>& out) {
  if (interaction_ != Interaction::none) return {};
  button_ = button;
  if (tool.tool != panel::Tool::suture) first_end_.reset();
  last_ = at;
  if (button == MouseButton::left && tool.tool == panel::Tool::scalpel) {
    begin_stroke(at, tool.depth, frame, surface_mesh);
    return {};
  }
  if (button == MouseButton::left && tool.tool == panel::Tool::cautery) {
    interaction_ = Interaction::burning;
    cautery_.press(pick(at, frame, surface_mesh), at, tool, out);
    return {};
  }
  if (button == MouseButton::left && tool.tool == panel::Tool::grasper)
    if (const auto clamp = clamp_at(at, frame, surface_mesh, controller_))
      return take_up(*clamp, at, frame, surface_mesh, out);
  const bool is_no_instrument = tool.tool == panel::Tool::measure || tool.tool == panel::Tool::select;
  if (button == MouseButton::left && !is_no_instrument)
    if (const auto hit = pick(at, frame, surface_mesh)) {
      if (tool.tool == panel::Tool::grasper) return grasp(*hit, frame, surface_mesh, tool.radius, out);
      if (tool.tool == panel::Tool::pin) return pin(*hit, frame, surface_mesh, tool.radius, out);
      if (tool.tool == panel::Tool::suture) return suture(*hit, surface_mesh, out);
      if (tool.tool == panel::Tool::remover) return remove(*hit, surface_mesh, tool.radius, out);
      if (tool.tool == panel::Tool::scissors) {
        interaction_ = Interaction::snipping;
        scissors_.press(*hit, at, tool, {frame, surface_mesh, section_});
        return {};
      }
      begin_probing(*hit, tool, at, out);
      return {};
    }
  press_background(button, at, shift, frame, surface_mesh);
  return {};
}

void MouseTool::press_background(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame,
                                 const SurfaceMesh& surface_mesh) {
  if (interaction_ != Interaction::none) return;
  button_ = button;
  last_ = at;
  const bool pans = button == MouseButton::middle || (button == MouseButton::right && shift);
  interaction_ = pans ? Interaction::panning : Interaction::orbiting;
  pivot_.reset();
  if (pans || button != MouseButton::right) return;
  if (const auto hit = pick(at, frame, surface_mesh)) pivot_ = hit->point;
}

/// Removes the pin at the hit, or sets one.
Status MouseTool::pin(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
                      std::vector<Command>& out) {
  const FreeNodes free(frame, surface_mesh);
  if (const int node = surface_mesh.nodes[static_cast<std::size_t>(hit.node)]; free.is_pinned(hit.node)) {
    out.emplace_back(Unpin{node});
    return {};
  }
  const auto nearest = free.nearest(hit, radius);
  if (!nearest) return free.why_none(hit);
  const int node = surface_mesh.nodes[static_cast<std::size_t>(*nearest)];
  out.emplace_back(PinTissue{node, radius, surface_mesh.hidden});
  return {};
}

/// Removes the elements round the hit.
Status MouseTool::remove(const render::Hit& hit, const SurfaceMesh& surface_mesh, double radius,
                         std::vector<Command>& out) {
  RemoveElements which;
  which.which.tets = elements_around(surface_mesh.nodes[static_cast<std::size_t>(hit.node)], surface_mesh, radius);
  if (!which.which.tets.empty()) out.emplace_back(std::move(which));
  return {};
}

Status MouseTool::grasp(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
                        std::vector<Command>& out) {
  const FreeNodes free(frame, surface_mesh);
  const auto nearest = free.nearest(hit, radius);
  if (!nearest) return free.why_none(hit);
  const int node = *nearest;
  const Grasp grasp{surface_mesh.nodes[static_cast<std::size_t>(node)], radius, 0, surface_mesh.hidden};
  if (const Status taken = held_by_another(grasp, frame); !taken.ok()) return taken;
  interaction_ = Interaction::grasping;
  anchor_ = hit.point;
  held_ = render::surface_point(hit, frame, surface_mesh);
  tool_offset_ = frame.positions[static_cast<std::size_t>(node)] - hit.point;
  hand_offset_.setZero();
  grasp_ = grasp;
  out.emplace_back(grasp_);
  return {};
}

/// Takes a clamp into the hand: the hand moves it from where it is, wherever on it the mouse is.
Status MouseTool::take_up(const GraspState& clamp, const render::Vec2f& at, const Frame& frame,
                          const SurfaceMesh& surface_mesh, std::vector<Command>& out) {
  const auto index = render::surface_index(clamp.node, surface_mesh);
  if (!index) return "What this clamp holds is hidden.";
  const auto is_corner = [&](const Triangle& triangle) {
    return std::find(triangle.begin(), triangle.end(), static_cast<int>(*index)) != triangle.end();
  };
  const auto triangle = std::find_if(surface_mesh.triangles.begin(), surface_mesh.triangles.end(), is_corner);
  const Vec3f& place = frame.positions[*index];
  interaction_ = Interaction::grasping;
  held_ = render::surface_point({static_cast<int>(triangle - surface_mesh.triangles.begin()), 0, place}, frame,
                                surface_mesh);
  anchor_ = controller_.drag(at, place);
  tool_offset_ = hand_offset_ = clamp.target.cast<float>() - anchor_;
  grasp_ = {clamp.node, clamp.radius, 0, surface_mesh.hidden};
  out.emplace_back(grasp_);
  return {};
}

Status MouseTool::leave_clamp(const Frame& frame, std::vector<Command>& out) {
  if (interaction_ != Interaction::grasping) return "Pull the tissue first: L then leaves the grasp there as a clamp.";
  const auto hand = free_hand(frame);
  if (!hand) return no_free_hand;
  out.emplace_back(Grasp{grasp_.node, grasp_.radius, *hand, grasp_.hidden});
  interaction_ = Interaction::none;
  return {};
}

bool MouseTool::remove_clamp(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh,
                             std::vector<Command>& out) const {
  const auto clamp = clamp_at(at, frame, surface_mesh, controller_);
  if (clamp) out.emplace_back(Release{clamp->hand});
  return clamp.has_value();
}

std::optional<render::Hold> MouseTool::hold() const {
  if (interaction_ != Interaction::grasping) return std::nullopt;
  return render::Hold{held_, controller_.drag(last_, anchor_) + hand_offset_};
}

/// The first click sets one end, the second the other.
Status MouseTool::suture(const render::Hit& hit, const SurfaceMesh& surface_mesh, std::vector<Command>& out) {
  const int node = surface_mesh.nodes[static_cast<std::size_t>(hit.node)];
  if (!first_end_) {
    first_end_ = node;
  } else {
    if (*first_end_ != node) out.emplace_back(SutureTissue{{*first_end_, node}, 0, 0.5});
    first_end_.reset();
  }
  return {};
}

/// Starts the probe above the surface and moves it in along the line of sight.
void MouseTool::begin_probing(const render::Hit& hit, const panel::ToolSettings& tool, const render::Vec2f& at,
                              std::vector<Command>& out) {
  interaction_ = Interaction::probing;
  anchor_ = hit.point;
  probe_ = tool;
  MoveProbe probe = probe_at(at);
  const Vec3 along = -probe.shaft.normalized();
  probe.path.insert(probe.path.begin(), probe.path.front() - (probe_.indentation + 0.1 * probe_.probe_radius) * along);
  out.emplace_back(std::move(probe));
}

/// The tip is `indentation` below the pressed point, moved in the plane that faces the camera; the shaft points to the
/// camera.
MoveProbe MouseTool::probe_at(const render::Vec2f& at) const {
  const Vec3 point = controller_.drag(at, anchor_).cast<double>();
  const Vec3 along = controller_.ray(at).direction.cast<double>().normalized();
  MoveProbe probe;
  probe.radius = probe_.probe_radius;
  probe.shaft = -probe_.shaft * along;
  probe.friction = probe_.friction;
  probe.path = {point + (probe_.indentation - probe_.probe_radius) * along};
  return probe;
}

bool MouseTool::wheel(float notches, std::vector<Command>& out) {
  if (interaction_ != Interaction::probing) return false;
  probe_.indentation += 0.1 * static_cast<double>(notches) * probe_.probe_radius;
  out.emplace_back(probe_at(last_));
  return true;
}

/// A stroke may begin beside the body: it enters where the mouse first meets tissue.
void MouseTool::begin_stroke(const render::Vec2f& at, double depth, const Frame& frame,
                             const SurfaceMesh& surface_mesh) {
  interaction_ = Interaction::cutting;
  depth_ = depth;
  has_entered_ = continues_stroke_ = false;
  beside_.reset();
  heading_.setZero();
  line_.clear();
  enter(at, frame, surface_mesh);
}

/// Puts the blade where the mouse last was beside the body, as far from the eye as the tissue that it meets at `at`:
/// the cut then takes the body's edge with it. Returns whether it meets tissue.
bool MouseTool::enter(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh) {
  const auto hit = pick(at, frame, surface_mesh);
  if (!hit) {
    beside_ = at;
    return false;
  }
  anchor_ = hit->point;
  cut_to_ = beside_.value_or(at);
  beside_.reset();
  blade_ = blade_at(controller_, cut_to_, anchor_, depth_);
  line_.add(*hit, frame, surface_mesh);
  has_entered_ = true;
  return true;
}

void MouseTool::cut(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh,
                    std::vector<Command>& out) {
  if (!has_entered_ && !enter(at, frame, surface_mesh)) return;
  if ((at - cut_to_).norm() < min_stroke) return;
  if (const auto hit = pick(at, frame, surface_mesh)) {
    anchor_ = hit->point;  // follows the relief of the surface
    line_.add(*hit, frame, surface_mesh);
  } else {
    line_.lift();
  }
  const std::array<Vec3, 2> now = blade_at(controller_, at, anchor_, depth_);
  out.emplace_back(CutTissue{{{blade_, now}}, continues_stroke_});
  heading_ = now[0] + now[1] - blade_[0] - blade_[1];
  blade_ = now;
  cut_to_ = at;
  continues_stroke_ = true;
}

render::StrokeDrawing MouseTool::stroke(const Frame& frame, const SurfaceMesh& surface_mesh) const {
  if (interaction_ == Interaction::snipping) return scissors_.drawing(frame, surface_mesh);
  if (interaction_ == Interaction::burning) return cautery_.drawing();
  if (interaction_ != Interaction::cutting || !has_entered_) return {};
  const std::array<Vec3, 2> now = blade_at(controller_, last_, anchor_, depth_);
  return {render::Blade{{now[0].cast<float>(), now[1].cast<float>()},
                        heading_.cast<float>(),
                        static_cast<float>(above_skin / (1 + above_skin))},
          line_.segments(frame, surface_mesh),
          std::nullopt};
}

void MouseTool::move(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh,
                     std::vector<Command>& out) {
  const render::Vec2f travel = at - last_;
  last_ = at;
  if (travel == render::Vec2f::Zero()) return;
  if (interaction_ == Interaction::orbiting) controller_.orbit(travel.x(), travel.y(), pivot_);
  if (interaction_ == Interaction::panning) controller_.pan(travel.x(), travel.y());
  if (interaction_ == Interaction::probing) out.emplace_back(probe_at(at));
  if (interaction_ == Interaction::snipping) scissors_.drag(at, {frame, surface_mesh, section_}, out);
  if (interaction_ == Interaction::burning) cautery_.drag(at, pick(at, frame, surface_mesh), out);
  if (interaction_ == Interaction::cutting) cut(at, frame, surface_mesh, out);
  if (interaction_ == Interaction::grasping) {
    const Vec3f point = controller_.drag(at, anchor_);
    out.emplace_back(MoveTool{(point + tool_offset_).cast<double>()});
  }
}

void MouseTool::release(MouseButton button, const Frame& frame, const SurfaceMesh& surface_mesh,
                        std::vector<Command>& out) {
  if (button != button_) return;
  if (interaction_ == Interaction::snipping) scissors_.release({frame, surface_mesh, section_}, out);
  stop(out);
}

void MouseTool::cancel(std::vector<Command>& out) {
  stop(out);
  first_end_.reset();
}

void MouseTool::stop(std::vector<Command>& out) {
  if (interaction_ == Interaction::grasping) out.emplace_back(Release{});
  if (interaction_ == Interaction::probing) out.emplace_back(WithdrawProbe{});
  interaction_ = Interaction::none;
}

}  // namespace heml::window
