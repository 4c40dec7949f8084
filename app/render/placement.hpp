#pragma once
// Model matrices of shapes of unit size that stand along +y from the origin.
#include <app/render/camera.hpp>
#include <cmath>

namespace heml::render {

/// y to `axis`, x towards `side`; m.
inline Mat4f place_along(const Vec3f& origin, const Vec3f& axis, const Vec3f& side, float length, float width) {
  const Vec3f y = axis.normalized();
  const Vec3f z = side.cross(y).normalized();
  Mat4f model = Mat4f::Identity();
  model.block<3, 1>(0, 0) = width * y.cross(z);
  model.block<3, 1>(0, 1) = length * y;
  model.block<3, 1>(0, 2) = width * z;
  model.block<3, 1>(0, 3) = origin;
  return model;
}

/// Turns about z through `pivot` by an angle (rad), from x towards y.
inline Mat4f turned_about(const Vec3f& pivot, float angle) {
  Mat4f model = Mat4f::Identity();
  const float c = std::cos(angle), s = std::sin(angle);
  model.block<2, 2>(0, 0) << c, -s, s, c;
  model.block<3, 1>(0, 3) = pivot - model.block<3, 3>(0, 0) * pivot;
  return model;
}

/// A direction not parallel to `axis`.
inline Vec3f across(const Vec3f& axis) {
  return std::abs(axis.normalized().y()) < 0.9f ? Vec3f(Vec3f::UnitY()) : Vec3f(Vec3f::UnitX());
}

}  // namespace heml::render
