#pragma once
// Where held nodes are at a time: contract, "boundary".
#include <heml/math/types.hpp>

namespace heml {

/// rotate(X − origin) + origin + translate, translation and angle ramped linearly over `over` seconds from t = 0, then
/// held.
struct PrescribedMotion {
  Vec3 translate, axis, origin;  ///< m; axis unit
  double radians = 0;
  double ramp_time = 0;  ///< s; 0: at once

  struct At {
    Vec3 x, v, a;  ///< m, m/s, m/s²
  };
  /// Position, velocity and acceleration at time t (s) of a node whose rest position is X.
  At operator()(const Vec3& X, double time) const;
};

}  // namespace heml
