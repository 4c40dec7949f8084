#pragma once
// Draws the tools: forceps at the target of a grasp and the spring to the grasped tissue, pins, the probe, a table
// under the body, threads of sutures, a scalpel that shows through the tissue, and the line that it has drawn.
#include <app/render/camera.hpp>
#include <app/render/solid_mesh.hpp>
#include <app/render/stroke_drawing.hpp>
#include <heml/session/frame.hpp>
#include <vector>

namespace heml::render {

/// Camera and light of a picture.
struct ViewContext {
  const Camera& camera;
  Size size;
  Mat4f view, projection;
  Mat4f view_projection;
  Vec3f key_direction;  ///< unit, towards the key light
  float radius;         ///< m, of the body at rest
};

class ToolDrawing {
 public:
  /// Places the tools of a frame, or none if not shown. Call this first.
  void place(const Frame& frame, bool shown, const ViewContext& shot);

  /// Adds the scalpel and its line to them.
  void place_stroke(const StrokeDrawing& stroke, const ViewContext& shot);

  void cast(const Program& program) const;  ///< draws the shadow casters; sets `model`
  void draw(const ViewContext& shot) const;
  void draw_outline(const ViewContext& shot);  ///< strips that fade outwards, see outline.hpp

 private:
  // A solid and its placement.
  struct Part {
    SolidMesh* mesh;
    Mat4f model = Mat4f::Identity();
    Vec3f tint = Vec3f::Zero();
    float metal = 0;  // 1: steel, 0: enamel
    bool casts = true;
    bool shows_through = false;  // its part inside the tissue is drawn too, fainter
  };
  void place_grasp(const GraspState& tool, const ViewContext& shot);
  void place_probe(const ProbeState& probe);
  void place_table(const Table& table, const Frame& frame, const ViewContext& shot);
  void place_suture(const SutureState& suture, const ViewContext& shot);
  void place_blade(const Blade& blade, const ViewContext& shot);
  void draw_hidden(const ViewContext& shot) const;
  void place_pin(const PinState& pin, const ViewContext& shot);
  void prepare(const Program& program, const ViewContext& shot, const Part& part) const;

  Program solid_{"solid.vert", "solid.frag"};
  Program strip_{"solid.vert", "solid.frag", {"OUTLINE"}};
  Program hidden_{"solid.vert", "solid.frag", {"HIDDEN"}};
  SolidMesh forceps_{forceps()}, rod_{rod()}, needle_{needle()}, ball_{ball()}, disc_{disc()};
  SolidMesh blade_{scalpel_blade()}, handle_{scalpel_handle()};
  std::vector<Part> parts_;
};

}  // namespace heml::render
