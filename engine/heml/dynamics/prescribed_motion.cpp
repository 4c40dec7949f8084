#include <heml/dynamics/prescribed_motion.hpp>
#include <heml/math/rotation.hpp>

namespace heml {

PrescribedMotion::At PrescribedMotion::operator()(const Vec3& X, double time) const {
  const bool moving = ramp_time > 0 && time < ramp_time;
  const double part = moving ? (time > 0 ? time / ramp_time : 0.0) : 1.0;
  At at{X, Vec3::Zero(), Vec3::Zero()};
  Vec3 arm = X - origin;
  if (radians != 0) {
    arm = rotation_matrix(axis, part * radians) * arm;
    at.x = arm + origin;
  }
  at.x += part * translate;
  if (moving) {
    const Vec3 rate = radians / ramp_time * axis;
    at.v = rate.cross(arm) + translate / ramp_time;
    at.a = rate.cross(rate.cross(arm));
  }
  return at;
}

}  // namespace heml
