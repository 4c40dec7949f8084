#pragma once
// Prescribed motion of constrained nodes (scene key `boundary`, app/docs/scene-format.md).
#include <heml/math/types.hpp>

namespace heml {

/// x = rotate(X − origin) + origin + translate. Translation and angle grow linearly from t = 0 over ramp_time, then
/// stay constant.
struct PrescribedMotion {
  Vec3 translate, axis, origin;  ///< m; axis unit
  double radians = 0;
  double ramp_time = 0;  ///< s; 0: at once

  struct At {
    Vec3 x, v, a;  ///< m, m/s, m/s²
  };
  /// Position, velocity and acceleration at a time (s) of a node with rest position X.
  At operator()(const Vec3& X, double time) const;
};

}  // namespace heml
