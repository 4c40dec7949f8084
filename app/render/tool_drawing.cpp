#include "app/render/tool_drawing.hpp"

#include <cmath>

namespace heml::render {
namespace {

constexpr float half_tension = 0.5f;  // N at which the spring is half way from calm to alarming

// A shape along +y from the origin, turned to `axis`, its x axis towards `side`.
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

Vec3f tension_tint(float force) {
  const float strain = force / (force + half_tension);
  const Vec3f calm(0.03f, 0.36f, 0.29f), firm(0.62f, 0.30f, 0.02f), alarming(0.55f, 0.015f, 0.01f);
  return strain < 0.5f ? Vec3f(calm + 2 * strain * (firm - calm)) : Vec3f(firm + (2 * strain - 1) * (alarming - firm));
}

}  // namespace

void ToolDrawing::place(const ToolState& tool, const Shot& shot) {
  forceps_.reset();
  spring_.reset();
  const Vec3f target = tool.target.cast<float>(), grip = tool.grip.cast<float>();
  if (!tool.active || !target.allFinite() || !grip.allFinite()) return;
  const Vec3f right = shot.camera.right();
  const Vec3f axis = Vec3f::UnitY() + 0.55f * right;  // leans out of the picture's middle, as a right hand holds it
  const Vec3f side = right + 0.5f * shot.camera.up().cross(right);
  const float length = 1.5f * shot.radius, thickness = 0.008f * shot.radius;
  forceps_ = Part{place_along(target, axis, side, length, length), Vec3f(0.80f, 0.83f, 0.86f), 1};
  const Vec3f reach = target - grip;
  if (reach.norm() <= thickness) return;
  const Vec3f other = std::abs(reach.normalized().y()) < 0.9f ? Vec3f::UnitY() : Vec3f::UnitX();
  spring_ = Part{place_along(grip, reach, other, reach.norm(), thickness),
                 tension_tint(static_cast<float>(tool.force.norm())), 0};
}

void ToolDrawing::cast(const Program& program) const {
  if (!forceps_) return;
  program.set("model", forceps_->model);
  forceps_mesh_.draw();
}

void ToolDrawing::prepare(const Program& program, const Shot& shot, const Part& part) const {
  program.use();
  program.set("view_projection", shot.view_projection);
  program.set("eye", shot.camera.eye());
  program.set("key_direction", shot.key_direction);
  program.set("model", part.model);
  program.set("tint", part.tint);
  program.set("metal", part.metal);
}

void ToolDrawing::draw(const Shot& shot) const {
  const auto draw_part = [&](const std::optional<Part>& part, const SolidMesh& mesh) {
    if (!part) return;
    prepare(solid_, shot, *part);
    mesh.draw();
  };
  draw_part(forceps_, forceps_mesh_);
  draw_part(spring_, rod_mesh_);
}

void ToolDrawing::draw_outline(const Shot& shot) {
  const auto draw_part = [&](const std::optional<Part>& part, SolidMesh& mesh) {
    if (!part) return;
    prepare(strip_, shot, *part);
    const Vec3f eye = (part->model.inverse() * shot.camera.eye().homogeneous()).head<3>();
    mesh.draw_outline(eye, shot.view_projection * part->model, shot.size);
  };
  draw_part(forceps_, forceps_mesh_);
  draw_part(spring_, rod_mesh_);
}

}  // namespace heml::render
