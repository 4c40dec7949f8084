#pragma once
// What the mouse does to the body and to the eye. Pixels from the top left corner of the picture.
#include <app/panel/actions.hpp>
#include <app/panel/camera_controller.hpp>
#include <app/render/pick.hpp>
#include <heml/session/frame.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <vector>

namespace heml::window {

enum class MouseButton { left, right, middle };

class MouseTool {
 public:
  enum class Doing { nothing, grasping, cutting, probing, orbiting, panning };

  explicit MouseTool(panel::CameraController& controller) : controller_(controller) {}

  /// A button went down at a place off the panel. Left on the body takes hold of it, sets the blade
  /// to it, or pins it. Returns
  /// true when the body is there but cannot be taken, because the scene holds it.
  bool press(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame,
             const SurfaceMesh& surface_mesh, const panel::ToolSettings& tool, std::vector<Command>& out);
  /// The same where there is nothing to take: the eye turns or moves.
  void press_background(MouseButton button, const render::Vec2f& at, bool shift);
  /// What is held follows; a blade cuts on from where it was.
  void move(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  /// Pushes a probe deeper by a notch of the wheel, or back. Returns false where there is none.
  bool wheel(float notches, std::vector<Command>& out);
  void release(MouseButton button, std::vector<Command>& out);
  /// Ends whatever the hand does, and what it has begun.
  void let_go(std::vector<Command>& out);

  Doing doing() const { return doing_; }
  /// The end of a suture that waits for its other one: mesh-file number of a node.
  std::optional<int> first_end() const { return first_end_; }
  /// The part of the body under a point of the picture.
  std::optional<render::Hit> under(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh) const;

 private:
  void stop(std::vector<Command>& out);
  static std::optional<int> free_corner(const render::Hit& hit, const SurfaceMesh& surface_mesh);
  void begin_probing(const render::Hit& hit, const panel::ToolSettings& tool, const render::Vec2f& at,
                     std::vector<Command>& out);
  MoveProbe probe_at(const render::Vec2f& at) const;
  bool suture(const render::Hit& hit, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  bool pin(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
           std::vector<Command>& out);
  bool grasp(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
             std::vector<Command>& out);
  void cut(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  std::array<Vec3, 2> blade_at(const render::Vec2f& at) const;

  panel::CameraController& controller_;
  Doing doing_ = Doing::nothing;
  MouseButton button_ = MouseButton::left;        // that began it
  render::Vec2f last_ = render::Vec2f::Zero();    // where the mouse was
  Vec3f held_point_ = Vec3f::Zero();              // m, of the surface, where it was taken
  Vec3f node_offset_ = Vec3f::Zero();             // m, from there to the node that was taken
  double depth_ = 0;                              // m, of the blade below held_point_
  std::array<Vec3, 2> blade_;                     // m, where it has cut up to
  render::Vec2f cut_to_ = render::Vec2f::Zero();  // the same, in the picture
  panel::ToolSettings probe_;                     // as it was when the probe was taken
  std::optional<int> first_end_;                  // of a suture
  bool continues_stroke_ = false;                 // this stroke has cut before
};

}  // namespace heml::window
