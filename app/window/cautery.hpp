#pragma once
// The electrode at the mouse: it burns a spot where it is pressed on the tissue, and goes on along its way over it.
// Beside the tissue it does nothing.
#include <app/panel/actions.hpp>
#include <app/render/pick.hpp>
#include <app/render/stroke_drawing.hpp>
#include <app/window/blade.hpp>
#include <heml/world/command.hpp>
#include <vector>

namespace heml::window {

class Cautery {
 public:
  explicit Cautery(const panel::CameraController& controller) : controller_(controller) {}

  /// The button went down on the tissue.
  void press(const render::Hit& hit, const render::Vec2f& at, const panel::ToolSettings& tool,
             std::vector<Command>& out);
  /// The mouse moved. hit: of the tissue there, if it meets any.
  void drag(const render::Vec2f& at, const std::optional<render::Hit>& hit, std::vector<Command>& out);
  /// The electrode at the mouse.
  render::StrokeDrawing drawing() const;

 private:
  void burn(Sweep sweep, std::vector<Command>& out);
  std::array<Vec3, 2> electrode_at(const render::Vec2f& at) const;

  const panel::CameraController& controller_;
  panel::ToolSettings tool_;
  Vec3f anchor_ = Vec3f::Zero();                           // m, of the skin, where it last touched that
  std::array<Vec3, 2> last_{Vec3::Zero(), Vec3::Zero()};   // m, the electrode where it last burnt
  render::Vec2f at_ = render::Vec2f::Zero(), burnt_to_ = at_;  // pixels, of the mouse, now and there
  bool is_lifted_ = false;                                 // the mouse has been beside the tissue since
  bool continues_stroke_ = false;                          // it has burnt since the press
};

}  // namespace heml::window
