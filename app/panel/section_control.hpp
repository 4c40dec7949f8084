#pragma once
// The section plane as it is set: rows of the section "View", and the handle in the image that drags it.
#include <app/panel/camera_controller.hpp>
#include <app/panel/rows.hpp>
#include <app/render/bounds.hpp>
#include <app/render/section.hpp>
#include <heml/scenario/scene.hpp>
#include <optional>

namespace heml::panel {

class SectionControl {
 public:
  /// Starts with the plane of a scene's view, or off.
  SectionControl(const View& view, const SurfaceMesh& surface_mesh);

  void draw(Rows& rows);
  void toggle();  ///< off; on again as it was last, at first across x
  bool is_on() const { return axis_ != Axis::off; }
  std::optional<render::SectionPlane> plane() const;
  void write_into(View& view) const;

  /// Middle of the plane's part in the body, m: where the handle is.
  Vec3f handle() const;
  float radius() const { return ball_.radius; }  ///< m, of the body at rest
  /// Moves the plane along its normal by what the mouse travels on the handle (pixels).
  void drag(const render::Vec2f& from, const render::Vec2f& to, const CameraController& controller);

 private:
  enum class Axis { off, x, y, z, free };

  Vec3f normal() const;
  void move_to(double at);

  render::BoundingSphere ball_;
  Axis axis_ = Axis::off, last_ = Axis::x;
  bool flipped_ = false;
  double at_ = 0;                        // m, along the normal from the body's centre
  double azimuth_ = 45, elevation_ = 0;  // degrees, of a free normal
};

}  // namespace heml::panel
