#pragma once
// Bounding sphere of a body, for cameras, lights and line widths.
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

/// The smallest ball about the centre of the bounding box that contains all points. Ignores points that are not finite;
/// the unit ball if there are no others.
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
