#pragma once
// A hand that a device moves (hand_device.hpp), beside the mouse: forceps float in the view, take hold of the tissue
// nearest to their tips, pull it and let go. Its number is that of its commands. All in the current pane.
//
//    hidden ── the device moves ──► free ── grasp, tissue in reach ──► holding ── grasp or clamp ──► free
//
// What it holds may be taken from it: by an undo or a reset, or because tissue went. A frame that no longer shows it
// says so.
#include <app/panel/actions.hpp>
#include <app/panel/camera_controller.hpp>
#include <app/render/grasp_pose.hpp>
#include <app/window/hand_device.hpp>
#include <heml/base/status.hpp>
#include <heml/session/frame.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <vector>

namespace heml::window {

class DeviceHand {
 public:
  /// What the hand sees of the body. section: as MouseTool::set_section().
  struct Scene {
    const Frame& frame;
    const SurfaceMesh& surface_mesh;
    const std::optional<render::SectionPlane>& section;
    double radius;  ///< m, of a grasp: ToolSettings::radius
  };

  /// number: of the hand, from first_device_hand.
  DeviceHand(int number, panel::CameraController& controller) : number_(number), controller_(controller) {}

  /// What the device is made to do from now on; a button that goes down is remembered for the next act(). Returns
  /// whether there is anything to draw.
  bool adopt(const HandState& state);
  /// Moves and grasps as the device was made to in the last `seconds`. moves_view: the view in place of the hand, which
  /// is hidden unless it holds something. Returns why it cannot.
  Status act(float seconds, bool moves_view, const Scene& scene, std::vector<Command>& out);
  /// Leaves what it holds where it is, as a clamp. Returns why it cannot.
  Status leave_clamp(const Frame& frame, std::vector<Command>& out);
  void let_go(std::vector<Command>& out);
  /// The device has gone: leaves a clamp, or lets go where there is no hand for one, and hides. Returns what became of
  /// what it held; empty: it held nothing.
  std::string unplug(const Frame& frame, std::vector<Command>& out);
  /// Until the device moves again. What it holds is forgotten: the body is another.
  void hide();

  int number() const { return number_; }
  bool is_shown() const { return tip_.has_value(); }
  bool has_moved() const { return has_moved_; }  ///< the device, since it came
  bool holds() const { return held_.has_value(); }
  bool has_grasped() const { return has_grasped_; }
  std::optional<render::Hold> hold() const;
  /// Tips of open forceps, m; none: hidden, or it holds something.
  std::optional<Vec3f> free_tip() const { return holds() ? std::nullopt : tip_; }
  /// What a grasp would take; none: no tissue is in reach, or it holds some.
  std::optional<render::Hit> in_reach(const Scene& scene) const;

 private:
  struct Held {
    Grasp grasp;
    render::SurfacePoint at;
    Vec3f tool_offset;  // m, from the tips to the tool of the grasp
    long refusals;      // Frame::refusals when it was taken
    bool is_seen = false;  // by a frame
  };
  void appear(const Scene& scene);
  bool move(float seconds);
  void turn_view(float seconds);
  void move_view(float seconds);
  Status grasp(const Scene& scene, std::vector<Command>& out);
  bool take_up_clamp(const Scene& scene, std::vector<Command>& out);
  void notice_loss(const Frame& frame, std::vector<Command>& out);
  float reach(const Scene& scene) const;
  float metres_per_pixel(const Vec3f& at) const;
  float height() const { return static_cast<float>(controller_.pane().size.height); }

  int number_;
  panel::CameraController& controller_;
  HandState state_;
  bool grasp_pressed_ = false, clamp_pressed_ = false;  // since the last act()
  bool has_grasped_ = false, has_moved_ = false;
  std::optional<Vec3f> tip_;  // m
  std::optional<Held> held_;
};

}  // namespace heml::window
