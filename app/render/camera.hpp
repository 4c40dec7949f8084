#pragma once
// A camera that orbits a target, with y up. Pixel coordinates start at the top left corner.
#include <app/render/image.hpp>
#include <heml/math/types.hpp>

namespace heml::render {

using Mat4f = Eigen::Matrix4f;
using Vec2f = Eigen::Vector2f;

struct Ray {
  Vec3f origin;     ///< m
  Vec3f direction;  ///< unit
};

class Camera {
 public:
  /// Looks at a ball (centre and radius in m) from the front and slightly above, so that it fills most of the view.
  void fit(const Vec3f& centre, float radius, Size size);

  void look(float azimuth, float elevation);   ///< sets the angles, rad; 0, 0: along −z
  void orbit(float azimuth, float elevation);  ///< adds to the angles, rad; elevation stays within ±89°
  void pan(float right, float up);             ///< moves eye and target by fractions of the visible height
  void zoom(float factor);                     ///< multiplies the distance; stays between 0.2 and 50 radii

  const Vec3f& target() const { return target_; }
  Vec3f eye() const;                                 ///< m
  Vec3f right() const;                               ///< unit, along the picture's x axis
  Vec3f up() const;                                  ///< unit, against the picture's y axis
  Mat4f view() const;                                ///< world to eye space, OpenGL's convention
  Mat4f projection(Size size) const;                 ///< eye space to clip space
  Ray ray(float x, float y, Size size) const;        ///< through a point of the picture
  Vec2f pixel(const Vec3f& point, Size size) const;  ///< projection of a point in front of the eye
  /// Intersection of a pixel's ray with the plane through `point` parallel to the image plane: the target of a drag, m.
  Vec3f drag(float x, float y, Size size, const Vec3f& point) const;

 private:
  Vec3f backward() const;  // unit, from target to eye

  Vec3f target_ = Vec3f::Zero();
  float radius_ = 1;    // of the ball last fitted, m
  float distance_ = 4;  // eye to target, m
  float azimuth_ = 0, elevation_ = 0;
};

}  // namespace heml::render
