#include <heml/dynamics/prescribed_motion.hpp>
#include <heml/math/rotation.hpp>

namespace heml {

PrescribedMotion::At PrescribedMotion::operator()(const Vec3& X, double time) const {
  const double part = ramp(time);
  At at{X, Vec3::Zero(), Vec3::Zero()};
  Vec3 arm = X - origin;
  if (radians != 0) {
    arm = rotation_matrix(axis, part * radians) * arm;
    at.x = arm + origin;
  }
  at.x += part * translate;
  if (ramp.is_growing(time)) {
    const Vec3 rate = radians / ramp.duration * axis;
    at.v = rate.cross(arm) + translate / ramp.duration;
    at.a = rate.cross(rate.cross(arm));
  }
  return at;
}

}  // namespace heml
