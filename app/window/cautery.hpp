#pragma once
// The electrode at the mouse: it burns a spot where it is pressed on the tissue or comes upon it, and goes on along its
// way over it. Beside the tissue it does nothing.
#include <app/panel/actions.hpp>
#include <app/render/pick.hpp>
#include <app/render/stroke_drawing.hpp>
#include <app/window/blade.hpp>
#include <heml/world/command.hpp>
#include <optional>
#include <vector>

namespace heml::window {

class Cautery {
 public:
  explicit Cautery(const panel::CameraController& controller) : controller_(controller) {}

  /// The button went down. hit: of the tissue there, if it meets any.
  void press(const std::optional<render::Hit>& hit, const render::Vec2f& at, const panel::ToolSettings& tool,
             std::vector<Command>& out);
  /// The mouse moved. hit: of the tissue there, if it meets any.
  void drag(const render::Vec2f& at, const std::optional<render::Hit>& hit, std::vector<Command>& out);
  /// The electrode at the mouse, once it has touched the tissue.
  render::StrokeDrawing drawing() const;

 private:
  void burn(Sweep sweep, std::vector<Command>& out);
  /// As the scalpel's edge; without depth it is its tip alone, on the skin.
  std::array<Vec3, 2> electrode_on(const render::Hit& skin);

  const panel::CameraController& controller_;
  panel::ToolSettings tool_;
  std::optional<Vec3f> anchor_;                            // m, of the skin, where it last touched that
  std::array<Vec3, 2> last_{Vec3::Zero(), Vec3::Zero()};   // m, the electrode where it last burnt
  render::Vec2f at_ = render::Vec2f::Zero(), burnt_to_ = at_;  // pixels, of the mouse, now and there
  bool is_lifted_ = false;                                 // the mouse has been beside the tissue since
  bool continues_stroke_ = false;                          // it has burnt since the press
};

}  // namespace heml::window
