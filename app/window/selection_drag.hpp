#pragma once
// The left button with the select tool: a click takes the node under it, a drag those within a rectangle, within the
// line drawn, or near where it passes.
//
// What goes through the body, and what is painted, takes nodes inside it too.
//
//    press ┌ ─ ─ ─ ─ ┐
//          │ •  •  • │      pixels; nodes of the surface in a frame
//          └ ─ ─ ─ ─ ┘ let go
#include <app/panel/camera_controller.hpp>
#include <app/panel/selection_section.hpp>
#include <app/render/pick.hpp>
#include <heml/session/frame.hpp>

namespace heml::window {

class SelectionDrag {
 public:
  using Drag = panel::SelectionSection::Drag;
  using How = panel::NodeSelection::How;
  struct Settings {
    Drag drag = Drag::rectangle;
    bool through = false;  ///< takes nodes behind other tissue too
    double radius = 0;     ///< m, of paint
    How how = How::replace;
  };
  struct View {
    const Frame& frame;
    const SurfaceMesh& surface_mesh;
    const panel::CameraController& controller;
    const std::optional<render::SectionPlane>& section;
  };

  /// Mesh-file numbers of nodes, ascending.
  struct Nodes {
    std::vector<int> surface;
    std::vector<int> inside;  ///< below it, where the frame has the solid
  };

  bool is_on() const { return on_; }
  void cancel() { on_ = false; }
  void press(const render::Vec2f& at, const Settings& settings, const View& view);
  void move(const render::Vec2f& at, const View& view);
  /// Ends it.
  Nodes release(const View& view);
  How how() const { return settings_.how; }
  /// What it encloses so far, pixels; empty while it paints.
  std::vector<render::Vec2f> outline() const;
  const std::vector<int>& painted() const { return painted_.surface; }  ///< so far

 private:
  bool is_click() const;
  void paint(const render::Vec2f& at, const View& view);

  bool on_ = false;
  Settings settings_;
  std::vector<render::Vec2f> path_;  // pixels
  Nodes painted_;
};

}  // namespace heml::window
