#pragma once
// Prescribed motion of constrained nodes (scene key `boundary`, app/docs/scene-format.md).
#include <heml/math/ramp.hpp>
#include <heml/math/types.hpp>

namespace heml {

/// x = rotate(X − origin) + origin + translate, translation and angle times the ramp.
struct PrescribedMotion {
  Vec3 translate, axis, origin;  ///< m; axis unit
  double radians = 0;
  Ramp ramp = {};

  struct At {
    Vec3 x, v, a;  ///< m, m/s, m/s²
  };
  /// Position, velocity and acceleration at a time (s) of a node with rest position X.
  At operator()(const Vec3& X, double time) const;
};

}  // namespace heml
