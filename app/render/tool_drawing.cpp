#include "app/render/tool_drawing.hpp"

#include <algorithm>
#include <cmath>

namespace heml::render {
namespace {

const Vec3f steel(0.80f, 0.83f, 0.86f);
const Vec3f incision(0.090f, 0.004f,
                     0.006f);         // drawn as metal, which has no gloss of its own: the pieces look like one line
constexpr float along_sight = 0.8f;   // cosine
constexpr float half_tension = 0.5f;  // N at which the spring has its middle colour

// Model matrix of a shape along +y from the origin: y to `axis`, x towards `side`.
Mat4f place_along(const Vec3f& origin, const Vec3f& axis, const Vec3f& side, float length, float width) {
  const Vec3f y = axis.normalized();
  const Vec3f z = side.cross(y).normalized();
  Mat4f model = Mat4f::Identity();
  model.block<3, 1>(0, 0) = width * y.cross(z);
  model.block<3, 1>(0, 1) = length * y;
  model.block<3, 1>(0, 2) = width * z;
  model.block<3, 1>(0, 3) = origin;
  return model;
}

/// A direction not parallel to `axis`.
Vec3f across(const Vec3f& axis) {
  return std::abs(axis.normalized().y()) < 0.9f ? Vec3f(Vec3f::UnitY()) : Vec3f(Vec3f::UnitX());
}

Vec3f tension_tint(float force) {
  const float strain = force / (force + half_tension);
  const Vec3f calm(0.03f, 0.36f, 0.29f), firm(0.62f, 0.30f, 0.02f), alarming(0.55f, 0.015f, 0.01f);
  return strain < 0.5f ? Vec3f(calm + 2 * strain * (firm - calm)) : Vec3f(firm + (2 * strain - 1) * (alarming - firm));
}

}  // namespace

void ToolDrawing::place(const Frame& frame, bool shown, const ViewContext& shot) {
  parts_.clear();
  if (!shown) return;
  const ByKind placing{[&](const GraspState& grasp) { place_grasp(grasp, shot); },
                       [&](const PinState& pin) { place_pin(pin, shot); },
                       [&](const TableState& state) { place_table(state.table, frame, shot); },
                       [&](const ProbeState& probe) { place_probe(probe); },
                       [&](const SutureState& suture) { place_suture(suture, shot); },
                       [](const SelfContactState&) {}};
  for (const ToolState& tool : frame.tools) std::visit(placing, tool);
}

void ToolDrawing::place_grasp(const GraspState& tool, const ViewContext& shot) {
  const Vec3f target = tool.target.cast<float>(), grip = tool.grip.cast<float>();
  if (!target.allFinite() || !grip.allFinite()) return;
  const Vec3f right = shot.camera.right();
  const Vec3f axis = Vec3f::UnitY() + 0.55f * right;  // tilted to the right, as held by a right hand
  const Vec3f side = right + 0.5f * shot.camera.up().cross(right);
  const float length = 1.5f * shot.radius, thickness = 0.008f * shot.radius;
  parts_.push_back({&forceps_, place_along(target, axis, side, length, length), steel, 1});
  const Vec3f reach = target - grip;
  if (reach.norm() <= thickness) return;
  parts_.push_back({&rod_, place_along(grip, reach, across(reach), reach.norm(), thickness),
                    tension_tint(static_cast<float>(tool.force.norm())), 0, false});
}

void ToolDrawing::place_probe(const ProbeState& probe) {
  const Vec3f tip = probe.tip.cast<float>(), shaft = probe.end.cast<float>() - tip;
  if (!tip.allFinite() || !shaft.allFinite()) return;
  const float r = static_cast<float>(probe.radius);
  parts_.push_back({&ball_, place_along(tip, Vec3f::UnitY(), Vec3f::UnitX(), r, r), steel, 1});
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
  parts_.push_back({&disc_, place_along(middle, normal, across(normal), 0.06f * shot.radius, 1.7f * shot.radius),
                    Vec3f(0.055f, 0.075f, 0.08f), 0, false});
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

void ToolDrawing::draw(const ViewContext& shot) const {
  draw_hidden(shot);
  for (const Part& part : parts_) {
    prepare(solid_, shot, part);
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
