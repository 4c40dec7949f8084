#pragma once
// The grasping tool: forceps at its target, and the spring to the tissue it holds.
#include <app/render/camera.hpp>
#include <app/render/solid_mesh.hpp>
#include <heml/world/world.hpp>
#include <optional>

namespace heml::render {

/// What parts of a picture share.
struct Shot {
  const Camera& camera;
  Size size;
  Mat4f view, projection;
  Mat4f view_projection;
  Vec3f key_direction;  ///< unit, towards the key light
  float radius;         ///< m, of the body at rest
};

class ToolDrawing {
 public:
  /// Places the tool for a frame; call before the others.
  void place(const ToolState& tool, const Shot& shot);

  void cast(const Program& program) const;  ///< for shadows: sets `model`
  void draw(const Shot& shot) const;
  void draw_outline(const Shot& shot);  ///< strips that fade outwards, see outline.hpp

 private:
  // One solid at its place.
  struct Part {
    Mat4f model = Mat4f::Identity();
    Vec3f tint = Vec3f::Zero();
    float metal = 0;  // 1: steel, 0: enamel
  };
  void prepare(const Program& program, const Shot& shot, const Part& part) const;

  Program solid_{"solid.vert", "solid.frag"};
  Program strip_{"solid.vert", "solid.frag", {"OUTLINE"}};
  SolidMesh forceps_mesh_{forceps()}, rod_mesh_{rod()};
  std::optional<Part> forceps_, spring_;
};

}  // namespace heml::render
