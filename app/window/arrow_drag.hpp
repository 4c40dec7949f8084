#pragma once
// An arrow in the picture that stands for a force or for gravity, and whose tip is dragged: its direction and size.
//
//              ● tip       the tip follows the mouse in the plane that faces the camera; value = (tip − from) · scale.
//            ╱  0.12 N     When it is let go the arrow gets its usual length back, so that the next drag changes it by
//    from ──╱              as much again.
#include <app/panel/camera_controller.hpp>
#include <optional>

namespace heml::window {

/// A vector to draw and drag.
struct Arrow {
  Vec3f from = Vec3f::Zero();  ///< m
  Vec3 value = Vec3::Zero();
  float length = 1;   ///< m, that it is drawn with
  double usual = 1;   ///< of the value, that this length stands for while the value is 0
  Vec3f tip() const;  ///< m; at `from` where the value is 0
};

class ArrowDrag {
 public:
  bool is_on() const { return arrow_.has_value(); }
  /// Whether a pixel is on the tip of an arrow, within `reach` pixels.
  static bool is_on_tip(const Arrow& arrow, const render::Vec2f& at, float reach,
                        const panel::CameraController& controller);
  void press(const Arrow& arrow) {
    arrow_ = arrow;
    tip_ = arrow.tip();
  }
  /// along_axis: the value is along x, y or z, whichever it is nearest to.
  void move(const render::Vec2f& at, bool along_axis, const panel::CameraController& controller);
  /// Ends it. None: it was not moved.
  std::optional<Vec3> release();
  void cancel() { release(); }
  /// As dragged so far; call while it is on.
  const Vec3& value() const { return moved_ ? *moved_ : arrow_->value; }
  Vec3f tip() const;  ///< m

 private:
  double scale() const;  // of the value, per m

  std::optional<Arrow> arrow_;  // where it was pressed
  Vec3f tip_ = Vec3f::Zero();   // m, then
  std::optional<Vec3> moved_;
};

}  // namespace heml::window
