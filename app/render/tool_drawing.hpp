#pragma once
// Draws the tools: forceps on the grasped tissue and the line of their pull, clamps, pins, the probe, a table under the
// body, threads of sutures, scalpel or scissors and the line that they have cut, an electrode. Forceps and scalpel show
// through the tissue.
#include <app/render/camera.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/render/shadows.hpp>
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

/// The axis of an instrument that casts a fine shadow on the tissue.
struct Shade {
  Vec3f from = Vec3f::Zero(), to = Vec3f::Zero();  ///< m
  float width = 0;                                 ///< m; 0: there is none
};

class ToolDrawing {
 public:
  /// Places the tools of a frame and a person's hands, or none if not shown. Call this first.
  void place(const Frame& frame, const HandDrawing& hands, bool shown, const ViewContext& shot);

  /// Adds scalpel or scissors and their line to them, or an electrode.
  void place_stroke(const StrokeDrawing& stroke, const ViewContext& shot);

  /// Of the instrument in use, the last where there are several: forceps, probe, scalpel, scissors or electrode.
  const Shade& shade() const { return shade_; }
  void cast(const Program& program) const;  ///< draws the shadow casters; sets `model`
  std::vector<Eigen::AlignedBox3f> boxes() const;  ///< round every part, m
  /// m, least y of a table as it is drawn under a body at rest.
  static float lowest(const Table& table, const BoundingSphere& rest);
  void draw(const ViewContext& shot, const ShadowMap& shadows) const;
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
    bool is_shaded = false;      // the shadow of tissue and instruments falls on it
  };
  void place_grasp(const GraspState& tool, const HeldPatch& patch, const ViewContext& shot);
  void place_forceps(const HeldPatch& patch, bool open, const ViewContext& shot);
  void place_probe(const ProbeState& probe);
  void place_table(const Table& table, const Frame& frame, const ViewContext& shot);
  void place_suture(const SutureState& suture, const ViewContext& shot);
  void place_blade(const Blade& blade, const ViewContext& shot);
  void place_scissors(const Scissors& scissors, const ViewContext& shot);
  void place_electrode(const Electrode& electrode, const ViewContext& shot);
  void draw_hidden(const ViewContext& shot) const;
  void place_pin(const PinState& pin, const ViewContext& shot);
  void place_clamp(const HeldPatch& patch, const ViewContext& shot);
  void prepare(const Program& program, const ViewContext& shot, const Part& part) const;

  Program solid_{"solid.vert", "solid.frag"};
  Program shaded_{"solid.vert", "solid.frag", {"SHADED"}};
  Program strip_{"solid.vert", "solid.frag", {"OUTLINE"}};
  Program hidden_{"solid.vert", "solid.frag", {"HIDDEN"}};
  SolidMesh jaw_{forceps_jaw()}, rod_{rod()}, needle_{needle()}, ball_{ball()}, disc_{disc()};
  SolidMesh blade_{scalpel_blade()}, handle_{scalpel_handle()}, scissors_{scissors_half()};
  std::vector<Part> parts_;
  Shade shade_;
};

}  // namespace heml::render
