#include <Eigen/Geometry>
#include <heml/dynamics/motion.hpp>

namespace heml {

Motion::At Motion::operator()(const Vec3& X, double time) const {
  const bool moving = over > 0 && time < over;
  const double part = moving ? (time > 0 ? time / over : 0.0) : 1.0;
  At at{X, Vec3::Zero(), Vec3::Zero()};
  Vec3 arm = X - origin;
  if (radians != 0) {
    arm = Eigen::AngleAxisd(part * radians, axis) * arm;
    at.x = arm + origin;
  }
  at.x += part * translate;
  if (moving) {
    const Vec3 rate = radians / over * axis;
    at.v = rate.cross(arm) + translate / over;
    at.a = rate.cross(rate.cross(arm));
  }
  return at;
}

}  // namespace heml
