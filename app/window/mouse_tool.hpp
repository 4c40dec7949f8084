#pragma once
// The mouse on the image: applies tools to the body and moves the camera. Pixels from the top left corner of the image.
#include <app/panel/actions.hpp>
#include <app/panel/camera_controller.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/render/stroke_drawing.hpp>
#include <app/window/cautery.hpp>
#include <app/window/clamps.hpp>
#include <app/window/input_queue.hpp>
#include <app/window/scissors.hpp>
#include <heml/session/frame.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <vector>

namespace heml::window {

class MouseTool {
 public:
  using Interaction = panel::Interaction;

  explicit MouseTool(panel::CameraController& controller) : controller_(controller) {}

  /// A button went down off the panel: left on the body applies the tool (a scalpel's stroke may begin beside it), else
  /// the camera orbits or pans. Returns why the tool cannot act on the body there.
  Status press(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame,
               const SurfaceMesh& surface_mesh, const panel::ToolSettings& tool, std::vector<Command>& out);
  /// The same without a tool: the camera orbits or pans. A right drag that begins on tissue orbits about that point.
  void press_background(MouseButton button, const render::Vec2f& at, bool shift, const Frame& frame,
                        const SurfaceMesh& surface_mesh);
  /// Moves the grasp, the probe or the camera; a blade cuts on from its last position.
  void move(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  /// Pushes an active probe deeper by notches of the wheel (negative: back). Returns false without a probe.
  bool wheel(float notches, std::vector<Command>& out);
  void release(MouseButton button, const Frame& frame, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  /// Leaves the grasp under way where it is, as a clamp. Returns why it cannot.
  Status leave_clamp(const Frame& frame, std::vector<Command>& out);
  /// Removes the clamp drawn under a pixel. Returns false where there is none.
  bool remove_clamp(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh,
                    std::vector<Command>& out) const;
  /// Ends what the mouse does, and forgets the first end of a suture.
  void cancel(std::vector<Command>& out);

  /// What lies beyond the plane is not drawn, and no tool meets it.
  void set_section(const std::optional<render::SectionPlane>& plane) { section_ = plane; }

  const std::optional<render::SectionPlane>& section() const { return section_; }

  Interaction interaction() const { return interaction_; }
  /// Whether the press under way has met no tissue: it turns the camera, or its stroke has not entered yet.
  bool is_beside_body() const {
    return interaction_ == Interaction::orbiting || (interaction_ == Interaction::cutting && !has_entered_);
  }
  /// Whether a tool is being used on the body, not the camera.
  bool acts() const {
    return interaction_ != Interaction::none && interaction_ != Interaction::orbiting &&
           interaction_ != Interaction::panning;
  }
  /// The first end of an unfinished suture: mesh-file number of a node.
  std::optional<int> first_end() const { return first_end_; }
  /// What the grasper holds, where the mouse is now; none: it holds nothing.
  std::optional<render::Hold> hold() const;
  /// Open scissors over a hit, before a press.
  render::Scissors scissors_over(const render::Hit& hit, const panel::ToolSettings& tool) const {
    return scissors_.over(hit, tool);
  }
  /// Scalpel or scissors and their line while they cut, or the electrode, as the tissue lies in a frame; else empty.
  render::StrokeDrawing stroke(const Frame& frame, const SurfaceMesh& surface_mesh) const;
  /// What the camera turns about while it orbits, m; none: the middle of the view.
  std::optional<Vec3f> pivot() const { return interaction_ == Interaction::orbiting ? pivot_ : std::nullopt; }
  /// The point of the surface under a pixel.
  std::optional<render::Hit> pick(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh) const;

 private:
  Status take_up(const GraspState& clamp, const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh,
                 std::vector<Command>& out);
  void stop(std::vector<Command>& out);
  void begin_probing(const render::Hit& hit, const panel::ToolSettings& tool, const render::Vec2f& at,
                     std::vector<Command>& out);
  MoveProbe probe_at(const render::Vec2f& at) const;
  Status suture(const render::Hit& hit, const SurfaceMesh& surface_mesh, std::vector<Command>& out);
  static Status pin(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
                    std::vector<Command>& out);
  static Status remove(const render::Hit& hit, const SurfaceMesh& surface_mesh, double radius,
                       std::vector<Command>& out);
  Status grasp(const render::Hit& hit, const Frame& frame, const SurfaceMesh& surface_mesh, double radius,
               std::vector<Command>& out);
  void begin_stroke(const render::Vec2f& at, double depth, const Frame& frame, const SurfaceMesh& surface_mesh);
  bool enter(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh);
  void cut(const render::Vec2f& at, const Frame& frame, const SurfaceMesh& surface_mesh, std::vector<Command>& out);

  panel::CameraController& controller_;
  Interaction interaction_ = Interaction::none;
  MouseButton button_ = MouseButton::left;      // that began interaction_
  render::Vec2f last_ = render::Vec2f::Zero();  // of the mouse, pixels
  std::optional<Vec3f> pivot_;                  // m, of the orbit
  Vec3f anchor_ = Vec3f::Zero();                // m, of the surface, where the tool began
  Vec3f tool_offset_ = Vec3f::Zero();           // m, from there to the tool of the grasp
  Vec3f hand_offset_ = Vec3f::Zero();           // m, from there to where the hand is drawn
  render::SurfacePoint held_;                   // where the grasper took hold
  Grasp grasp_;                                 // under way
  double depth_ = 0;                            // m, of the blade below anchor_
  std::array<Vec3, 2> blade_;                   // m, end of the last cut
  Vec3 heading_ = Vec3::Zero();                 // m, of the blade's last movement
  StrokeLine line_;
  Scissors scissors_{controller_};
  Cautery cautery_{controller_};
  std::optional<render::SectionPlane> section_;
  render::Vec2f cut_to_ = render::Vec2f::Zero();  // the same, pixels
  panel::ToolSettings probe_;                     // of the active probe
  std::optional<int> first_end_;                  // of an unfinished suture
  std::optional<render::Vec2f> beside_;           // pixels, where a stroke that has not entered was last
  bool has_entered_ = false;                      // this stroke has met tissue
  bool continues_stroke_ = false;                 // this stroke has already cut
};

}  // namespace heml::window
