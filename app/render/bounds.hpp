#pragma once
// How large a body is and where it stands, for cameras, lights and line widths.
#include <algorithm>
#include <cmath>
#include <heml/math/types.hpp>
#include <span>

namespace heml::render {

struct BoundingSphere {
  Vec3f centre = Vec3f::Zero();  ///< m
  float radius = 1;              ///< m, above 0
  float lowest = 0;              ///< m, least y of the points
};

/// The ball about the middle of the points' box that holds them all. Points that are not finite are left out; without
/// any other the result is the unit ball.
inline BoundingSphere bounding_sphere(std::span<const Vec3f> points) {
  Eigen::AlignedBox3f box;
  for (const Vec3f& point : points)
    if (point.allFinite()) box.extend(point);
  if (box.isEmpty()) return {};
  BoundingSphere ball{box.center(), 0, box.min().y()};
  for (const Vec3f& point : points)
    if (point.allFinite()) ball.radius = std::max(ball.radius, (point - ball.centre).norm());
  if (ball.radius <= 0) ball.radius = 1;
  return ball;
}

}  // namespace heml::render
