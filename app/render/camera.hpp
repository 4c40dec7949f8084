#pragma once
// A camera that orbits a target, with y up. Pixel coordinates start at the top left corner.
#include <app/render/image.hpp>
#include <heml/math/types.hpp>
#include <heml/scenario/standard_view.hpp>

namespace heml::render {

using Mat4f = Eigen::Matrix4f;
using Vec2f = Eigen::Vector2f;

struct Ray {
  Vec3f origin;     ///< m
  Vec3f direction;  ///< unit
};

/// All that a camera is.
struct CameraPose {
  Vec3f target = Vec3f::Zero();      ///< m
  float radius = 1;                  ///< of the ball last fitted, m
  float distance = 4;                ///< eye to target, m
  float azimuth = 0, elevation = 0;  ///< rad
  bool orthographic = false;
  bool operator==(const CameraPose&) const = default;
};

class Camera {
 public:
  Camera() = default;
  explicit Camera(const CameraPose& pose) : pose_(pose) {}
  const CameraPose& pose() const { return pose_; }

  /// Looks at a ball (centre and radius in m) from the front and slightly above, so that it fills most of the view.
  void fit(const Vec3f& centre, float radius, Size size);

  void look(float azimuth, float elevation);   ///< sets the angles, rad; 0, 0: along −z
  void orbit(float azimuth, float elevation);  ///< adds to the angles, rad; elevation stays within ±90°
  /// The same about a point (m), which stays where it is in the picture.
  void orbit(float azimuth, float elevation, const Vec3f& pivot);
  void pan(float right, float up);             ///< moves eye and target by fractions of the visible height
  void zoom(float factor);                     ///< multiplies the distance; stays between 0.2 and 50 radii

  void set_orthographic(bool on) { pose_.orthographic = on; }  ///< what lies at the target keeps its size
  bool is_orthographic() const { return pose_.orthographic; }

  const Vec3f& target() const { return pose_.target; }
  Vec3f backward() const;                            ///< unit, from the target to the eye
  Vec3f eye() const;                                 ///< m; of an orthographic camera: far away, for directions alone
  Vec3f right() const;                               ///< unit, along the picture's x axis
  Vec3f up() const;                                  ///< unit, against the picture's y axis
  Mat4f view() const;                                ///< world to eye space, OpenGL's convention
  Mat4f projection(Size size) const;                 ///< eye space to clip space
  Ray ray(float x, float y, Size size) const;        ///< through a point of the picture
  Vec2f pixel(const Vec3f& point, Size size) const;  ///< projection of a point in front of the eye
  /// Intersection of a pixel's ray with the plane through `point` parallel to the image plane: the target of a drag, m.
  Vec3f drag(float x, float y, Size size, const Vec3f& point) const;

 private:
  Vec3f viewpoint() const { return pose_.target + pose_.distance * backward(); }
  float half_depth() const;  // m, of what an orthographic camera shows before and behind the target

  CameraPose pose_;
};

/// Unit, from the body to the eye.
Vec3f direction_of(StandardView view);

}  // namespace heml::render
