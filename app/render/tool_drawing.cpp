#include "app/render/tool_drawing.hpp"

#include <algorithm>
#include <app/render/placement.hpp>
#include <cmath>

namespace heml::render {
namespace {

const Vec3f steel(0.80f, 0.83f, 0.86f);
const Vec3f incision(0.090f, 0.004f,
                     0.006f);         // drawn as metal, which has no gloss of its own: the pieces look like one line
const Vec3f jaw_line(0.85f, 0.80f, 0.55f);
const Vec3f insulation(0.52f, 0.30f, 0.03f), electrode_handle(0.03f, 0.10f, 0.22f);
constexpr float along_sight = 0.8f;   // cosine
constexpr float half_tension = 0.5f;  // N at which the line of a pull has its middle colour
constexpr float shade_width = 0.035f;  // body radii
constexpr float slack = 0.03f;        // body radii: tissue that is nearer to the hand follows it
constexpr float table_thickness = 0.06f, table_radius = 1.7f;  // body radii

Vec3f tension_tint(float force) {
  const float strain = force / (force + half_tension);
  const Vec3f calm(0.03f, 0.36f, 0.29f), firm(0.62f, 0.30f, 0.02f), alarming(0.55f, 0.015f, 0.01f);
  return strain < 0.5f ? Vec3f(calm + 2 * strain * (firm - calm)) : Vec3f(firm + (2 * strain - 1) * (alarming - firm));
}

}  // namespace

void ToolDrawing::place(const Frame& frame, const HandDrawing& hands, bool shown, const ViewContext& shot) {
  parts_.clear();
  shade_ = {};
  if (!shown) return;
  for (const Vec3f& tip : hands.free_tips) place_forceps(free_patch(tip, shot.camera), true, shot);
  const auto held = [&](const GraspState& grasp) {
    return held_patch(grasp, hands.hold_of(grasp.hand), frame, frame.surface_mesh.get(), shot.camera.eye());
  };
  const ByKind placing{[&](const GraspState& grasp) {
                         if (is_clamp(grasp)) return place_clamp(held(grasp), shot);
                         place_grasp(grasp, held(grasp), shot);
                       },
                       [&](const PinState& pin) { place_pin(pin, shot); },
                       [&](const TableState& state) { place_table(state.table, frame, shot); },
                       [&](const ProbeState& probe) { place_probe(probe); },
                       [&](const SutureState& suture) { place_suture(suture, shot); },
                       [](const SelfContactState&) {}};
  for (const ToolState& tool : frame.tools) std::visit(placing, tool);
}

void ToolDrawing::place_grasp(const GraspState& tool, const HeldPatch& patch, const ViewContext& shot) {
  if (!patch.place.allFinite() || !patch.normal.allFinite() || !patch.pull.allFinite()) return;
  place_forceps(patch, false, shot);
  const float distance = patch.pull.norm();
  if (distance <= slack * shot.radius) return;
  parts_.push_back({&rod_, place_along(patch.place, patch.pull, across(patch.pull), distance, 0.004f * shot.radius),
                    tension_tint(static_cast<float>(tool.force.norm())), 0, false, true});
}

void ToolDrawing::place_forceps(const HeldPatch& patch, bool open, const ViewContext& shot) {
  const auto jaws = jaw_models(patch, shot.camera, shot.radius, open);
  for (const Mat4f& model : jaws) parts_.push_back({&jaw_, model, steel, 1, true, true});
  const Vec3f end = (jaws[0] * Vec3f::UnitY().homogeneous()).head<3>();
  shade_ = {patch.place, end, shade_width * shot.radius};
}

void ToolDrawing::place_probe(const ProbeState& probe) {
  const Vec3f tip = probe.tip.cast<float>(), shaft = probe.end.cast<float>() - tip;
  if (!tip.allFinite() || !shaft.allFinite()) return;
  const float r = static_cast<float>(probe.radius);
  parts_.push_back({&ball_, place_along(tip, Vec3f::UnitY(), Vec3f::UnitX(), r, r), steel, 1});
  shade_ = {tip, tip + shaft, r};
  if (shaft.norm() == 0) return;
  parts_.push_back({&rod_, place_along(tip, shaft, across(shaft), shaft.norm(), r), steel, 1});
}

/// A disc of the table's plane under the body.
void ToolDrawing::place_table(const Table& table, const Frame& frame, const ViewContext& shot) {
  if (frame.positions.empty()) return;
  Vec3f middle = Vec3f::Zero();
  for (const Vec3f& x : frame.positions) middle += x / static_cast<float>(frame.positions.size());
  const Vec3f normal = table.normal.cast<float>();
  middle -= normal.dot(middle - table.point.cast<float>()) * normal;
  if (!middle.allFinite()) return;
  parts_.push_back(
      {&disc_, place_along(middle, normal, across(normal), table_thickness * shot.radius, table_radius * shot.radius),
       Vec3f(0.055f, 0.075f, 0.08f), 0, false, false, true});
}

float ToolDrawing::lowest(const Table& table, const BoundingSphere& rest) {
  const Vec3f normal = table.normal.cast<float>();
  const Vec3f middle = rest.centre - normal.dot(rest.centre - table.point.cast<float>()) * normal;
  const float reach = table_radius * normal.cross(Vec3f::UnitY()).norm();
  return middle.y() - rest.radius * (reach + table_thickness * std::abs(normal.y()));
}

void ToolDrawing::place_suture(const SutureState& suture, const ViewContext& shot) {
  const Vec3f from = suture.ends[0].cast<float>(), direction = suture.ends[1].cast<float>() - from;
  const float thickness = 0.008f * shot.radius;
  if (!from.allFinite() || !direction.allFinite()) return;
  for (const Vec3& end : suture.ends)
    parts_.push_back({&ball_,
                      place_along(end.cast<float>(), Vec3f::UnitY(), Vec3f::UnitX(), 2 * thickness, 2 * thickness),
                      Vec3f(0.02f, 0.02f, 0.025f), 0});
  if (direction.norm() > thickness)
    parts_.push_back({&rod_, place_along(from, direction, across(direction), direction.norm(), thickness),
                      Vec3f(0.02f, 0.02f, 0.025f), 0});
}

/// Tilts the pin towards the eye, so that the tissue does not hide it.
void ToolDrawing::place_pin(const PinState& pin, const ViewContext& shot) {
  const Vec3f place = pin.place.cast<float>();
  if (!place.allFinite()) return;
  const Vec3f axis = shot.camera.up() + 0.8f * (shot.camera.eye() - place).normalized();
  const float length = 0.16f * shot.radius;
  parts_.push_back({&needle_, place_along(place, axis, across(axis), length, length),
                    tension_tint(static_cast<float>(pin.force.norm())), 0});
}

void ToolDrawing::place_clamp(const HeldPatch& patch, const ViewContext& shot) {
  if (!patch.place.allFinite() || !patch.normal.allFinite()) return;
  for (const Mat4f& model : clamp_models(patch, shot.camera, shot.radius))
    parts_.push_back({&scissors_, model, steel, 1, true, true});
}

void ToolDrawing::place_stroke(const StrokeDrawing& stroke, const ViewContext& shot) {
  const float thickness = 0.0045f * shot.radius;
  for (const auto& [from, to] : stroke.line) {
    // The drawn skin bulges over the flat faces that the points lie on.
    const Vec3f lift = 0.012f * shot.radius * (shot.camera.eye() - from).normalized(), along = to - from;
    if (!along.allFinite() || along.norm() == 0) continue;
    parts_.push_back(
        {&rod_, place_along(from + lift, along, across(along), along.norm(), thickness), incision, 1, false});
  }
  if (stroke.blade) place_blade(*stroke.blade, shot);
  if (stroke.scissors) place_scissors(*stroke.scissors, shot);
  if (stroke.electrode) place_electrode(*stroke.electrode, shot);
}

/// A bare needle on the skin, its insulation and the handle, leaning as the scalpel does.
void ToolDrawing::place_electrode(const Electrode& electrode, const ViewContext& shot) {
  if (!electrode.tip.allFinite()) return;
  const float r = shot.radius;
  const Vec3f to_eye = (shot.camera.eye() - electrode.tip).normalized();
  const Vec3f axis = (0.6f * to_eye + 0.9f * shot.camera.up() + 0.55f * shot.camera.right()).normalized();
  const auto add = [&](float from, float length, float radius, const Vec3f& tint, float metal) {
    parts_.push_back({&rod_, place_along(electrode.tip + from * r * axis, axis, across(axis), length * r, radius * r),
                      tint, metal});
  };
  add(0, 0.17f, 0.008f, steel, 1);
  add(0.15f, 0.10f, 0.017f, insulation, 0);
  add(0.25f, 1.1f, 0.027f, electrode_handle, 0);
  shade_ = {electrode.tip, electrode.tip + 1.3f * r * axis, shade_width * r};
}

/// Scissors lie over the jaw line with a blade on each side of it: along the line of sight, in which they cut, one would
/// see them edge-on. The tips touch the skin and the grips are nearer to the eye.
void ToolDrawing::place_scissors(const Scissors& scissors, const ViewContext& shot) {
  const Vec3f line = scissors.to - scissors.from, sight = (shot.camera.eye() - scissors.to).normalized();
  const Vec3f flat = line - line.dot(sight) * sight;
  if (!line.allFinite() || !(flat.norm() > 0)) return;
  constexpr float steepness = 0.5f;  // sine of the blades' angle with the picture
  const Vec3f axis = std::sqrt(1 - steepness * steepness) * flat.normalized() - steepness * sight;
  const float length = std::max(1.15f * line.norm(), 0.3f * shot.radius);
  const float half = std::clamp(std::atan(0.5f * scissors.opening / length), 0.14f, 0.4f) * (1 - 0.9f * scissors.closed);
  const Vec3f lift = 0.02f * shot.radius * sight;
  const Vec3f pivot = scissors.to + lift - length * std::cos(half) * axis, side = axis.cross(sight);
  for (const Vec3f& beside : {side, Vec3f(-side)})
    parts_.push_back({&scissors_, place_along(pivot, axis, beside, length, length) * turned_about(Vec3f::Zero(), -half),
                      steel, 1});
  shade_ = {scissors.to, pivot - length * axis, shade_width * shot.radius};
  parts_.push_back({&rod_, place_along(scissors.from + lift, line, across(line), line.norm(), 0.004f * shot.radius),
                    jaw_line, 0, false});
}

/// The blade trails behind its cutting edge; its handle is at the end nearer to the eye. A blade along the line of
/// sight would hide the tissue that it cuts and its own depth: it is drawn leaning about the point where it enters the
/// skin.
void ToolDrawing::place_blade(const Blade& blade, const ViewContext& shot) {
  const Vec3f eye = shot.camera.eye();
  Vec3f tip = blade.edge[0], top = blade.edge[1];
  if ((tip - eye).norm() < (top - eye).norm()) std::swap(tip, top);
  const Vec3f heading = blade.heading.norm() > 0 ? blade.heading : Vec3f(-shot.camera.right());
  const float length = (top - tip).norm();
  if (!std::isfinite(length) || !heading.allFinite() || length == 0) return;
  Vec3f axis = (top - tip) / length;
  if (axis.dot((eye - top).normalized()) > along_sight) {
    const Vec3f entry = top + blade.entry * (tip - top);
    axis = (0.6f * axis + 0.9f * shot.camera.up() + 0.55f * shot.camera.right()).normalized();
    tip = entry - (1 - blade.entry) * length * axis;
  }
  Vec3f back = heading.dot(axis) * axis - heading;
  back = back.norm() > 0 ? Vec3f(back.normalized()) : axis.unitOrthogonal();
  const float drawn = std::max(1.08f * length, 0.12f * shot.radius);
  const float width = std::clamp(0.24f * drawn, 0.05f * shot.radius, 0.12f * shot.radius);
  parts_.push_back({&blade_, place_along(tip, axis, back, drawn, width), steel, 1, true, true});
  shade_ = {tip, tip + (drawn + shot.radius) * axis, shade_width * shot.radius};
  parts_.push_back({&handle_,
                    place_along(tip + drawn * axis + 0.5f * width * back, axis, back, shot.radius, shot.radius), steel,
                    1});
}

void ToolDrawing::cast(const Program& program) const {
  for (const Part& part : parts_) {
    if (!part.casts) continue;
    program.set("model", part.model);
    part.mesh->draw();
  }
}

std::vector<Eigen::AlignedBox3f> ToolDrawing::boxes() const {
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const Part& part : parts_) {
    Eigen::AlignedBox3f& box = boxes.emplace_back();
    for (int k = 0; k < 8; ++k) {
      const Vec3f corner = part.mesh->box().corner(static_cast<Eigen::AlignedBox3f::CornerType>(k));
      box.extend((part.model * corner.homogeneous()).head<3>());
    }
  }
  return boxes;
}

void ToolDrawing::prepare(const Program& program, const ViewContext& shot, const Part& part) const {
  program.use();
  program.set("view_projection", shot.view_projection);
  program.set("eye", shot.camera.eye());
  program.set("key_direction", shot.key_direction);
  program.set("model", part.model);
  program.set("tint", part.tint);
  program.set("metal", part.metal);
}

/// Blends what is behind the body over it. Call it when the depth buffer holds the body alone.
void ToolDrawing::draw_hidden(const ViewContext& shot) const {
  if (std::none_of(parts_.begin(), parts_.end(), [](const Part& part) { return part.shows_through; })) return;
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_CULL_FACE);
  for (const Part& part : parts_) {
    if (!part.shows_through) continue;
    prepare(hidden_, shot, part);
    part.mesh->draw();
  }
  glDisable(GL_CULL_FACE);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

void ToolDrawing::draw(const ViewContext& shot, const ShadowMap& shadows) const {
  draw_hidden(shot);
  for (const Part& part : parts_) {
    const Program& program = part.is_shaded ? shaded_ : solid_;
    prepare(program, shot, part);
    if (part.is_shaded) {
      program.set("shadow_matrix", shadows.matrix());
      program.set("shadow_map", 0);
      glActiveTexture(GL_TEXTURE0);
      glBindTexture(GL_TEXTURE_2D, shadows.texture());
    }
    part.mesh->draw();
  }
}

void ToolDrawing::draw_outline(const ViewContext& shot) {
  for (const Part& part : parts_) {
    prepare(strip_, shot, part);
    const Vec3f eye = (part.model.inverse() * shot.camera.eye().homogeneous()).head<3>();
    part.mesh->draw_outline(eye, shot.view_projection * part.model, shot.size);
  }
}

}  // namespace heml::render
