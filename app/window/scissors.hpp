#pragma once
// Scissors: each time the jaws close they cut what lies between them, a straight piece as long as the jaws and as deep
// as they open. A click closes them once along the jaw line; a drag snips on along its way, piece joining piece, and
// letting go closes them on the rest:
//
//      press ●━━━━━┿━━━━━┿━━━━━┿━━● let go
#include <app/panel/actions.hpp>
#include <app/render/pick.hpp>
#include <app/render/stroke_drawing.hpp>
#include <app/window/blade.hpp>
#include <app/window/stroke_line.hpp>
#include <heml/world/command.hpp>
#include <vector>

namespace heml::window {

class Scissors {
 public:
  /// What the mouse sees. section: as MouseTool::set_section().
  struct Scene {
    const Frame& frame;
    const SurfaceMesh& surface_mesh;
    const std::optional<render::SectionPlane>& section;
  };

  explicit Scissors(const panel::CameraController& controller) : controller_(controller) {}

  /// The button went down on the surface.
  void press(const render::Hit& hit, const render::Vec2f& at, const panel::ToolSettings& tool, const Scene& scene);
  /// Snips as often as the mouse has gone a jaw's length.
  void drag(const render::Vec2f& at, const Scene& scene, std::vector<Command>& out);
  /// Closes the jaws on what the drag left, or, without a drag, along the jaw line.
  void release(const Scene& scene, std::vector<Command>& out);

  /// Scissors and the line that they have cut.
  render::StrokeDrawing drawing(const Frame& frame, const SurfaceMesh& surface_mesh) const;
  /// Open scissors over the surface, before a press.
  render::Scissors over(const render::Hit& hit, const panel::ToolSettings& tool) const;

 private:
  Vec3f jaw_line(const panel::ToolSettings& tool) const;
  void snip(const Vec3f& end, const Scene& scene, std::vector<Command>& out);

  const panel::CameraController& controller_;
  panel::ToolSettings tool_;
  Vec3f anchor_ = Vec3f::Zero();                                // m, of the surface, end of the last piece
  std::array<Vec3, 2> blade_{Vec3::Zero(), Vec3::Zero()};       // m, there
  render::Vec2f pressed_ = render::Vec2f::Zero(), at_ = pressed_;  // pixels, of the mouse
  StrokeLine line_;
  bool is_dragged_ = false;
  bool continues_stroke_ = false;  // it has snipped since the press
};

}  // namespace heml::window
