#include "app/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace heml::render {
namespace {

constexpr float degree = std::numbers::pi_v<float> / 180;
constexpr float field_of_view = 30 * degree;  // vertical; narrow, as a portrait lens
constexpr float margin = 1.22f;               // air round the fitted ball
constexpr float far_eye = 1000;               // distances from an orthographic camera's target to its eye

}  // namespace

void Camera::fit(const Vec3f& centre, float radius, Size size) {
  pose_.target = centre;
  pose_.radius = std::max(radius, 1e-6f);
  pose_.azimuth = 24 * degree;
  pose_.elevation = 20 * degree;
  const float half_height = std::tan(field_of_view / 2);
  const float half_angle = std::atan(half_height * std::min(1.0f, size.aspect()));
  pose_.distance = margin * pose_.radius / std::sin(half_angle);
}

void Camera::look(float azimuth, float elevation) {
  pose_.azimuth = pose_.elevation = 0;
  orbit(azimuth, elevation);
}

void Camera::orbit(float azimuth, float elevation) {
  pose_.azimuth = std::remainder(pose_.azimuth + azimuth, 360 * degree);
  pose_.elevation = std::clamp(pose_.elevation + elevation, -90 * degree, 90 * degree);
}

void Camera::orbit(float azimuth, float elevation, const Vec3f& pivot) {
  const Vec3f arm = pose_.target - pivot, seen(arm.dot(right()), arm.dot(up()), arm.dot(backward()));
  orbit(azimuth, elevation);
  pose_.target = pivot + seen.x() * right() + seen.y() * up() + seen.z() * backward();
}

void Camera::pan(float right_fraction, float up_fraction) {
  const float visible_height = 2 * pose_.distance * std::tan(field_of_view / 2);
  pose_.target += visible_height * (right_fraction * right() + up_fraction * up());
}

void Camera::zoom(float factor) {
  pose_.distance = std::clamp(pose_.distance * factor, 0.2f * pose_.radius, 50 * pose_.radius);
}

Vec3f Camera::backward() const {
  return {std::cos(pose_.elevation) * std::sin(pose_.azimuth), std::sin(pose_.elevation),
          std::cos(pose_.elevation) * std::cos(pose_.azimuth)};
}

Vec3f Camera::eye() const {
  return pose_.orthographic ? pose_.target + far_eye * pose_.distance * backward() : viewpoint();
}

// Wide enough for the ground; so wide that the depth offsets of lines and outlines are as long as in perspective.
float Camera::half_depth() const { return 10 * pose_.distance + 12 * pose_.radius; }

Vec3f Camera::right() const { return {std::cos(pose_.azimuth), 0, -std::sin(pose_.azimuth)}; }

Vec3f Camera::up() const { return backward().cross(right()); }

Mat4f Camera::view() const {
  Mat4f matrix = Mat4f::Identity();
  matrix.block<1, 3>(0, 0) = right().transpose();
  matrix.block<1, 3>(1, 0) = up().transpose();
  matrix.block<1, 3>(2, 0) = backward().transpose();
  matrix.block<3, 1>(0, 3) = -matrix.block<3, 3>(0, 0) * viewpoint();
  return matrix;
}

Mat4f Camera::projection(Size size) const {
  const float cotangent = 1 / std::tan(field_of_view / 2);
  Mat4f matrix = Mat4f::Zero();
  if (pose_.orthographic) {
    matrix(0, 0) = cotangent / pose_.distance / size.aspect();
    matrix(1, 1) = cotangent / pose_.distance;
    matrix(2, 2) = -1 / half_depth();
    matrix(2, 3) = -pose_.distance / half_depth();
    matrix(3, 3) = 1;
    return matrix;
  }
  const float near = 0.05f * pose_.distance;
  const float far = pose_.distance + 40 * pose_.radius;
  matrix(0, 0) = cotangent / size.aspect();
  matrix(1, 1) = cotangent;
  matrix(2, 2) = (far + near) / (near - far);
  matrix(2, 3) = 2 * far * near / (near - far);
  matrix(3, 2) = -1;
  return matrix;
}

Ray Camera::ray(float x, float y, Size size) const {
  const float half_height = std::tan(field_of_view / 2);
  const float across = (2 * x / static_cast<float>(size.width) - 1) * half_height * size.aspect();
  const float upward = (1 - 2 * y / static_cast<float>(size.height)) * half_height;
  if (pose_.orthographic)
    return {pose_.target + pose_.distance * (across * right() + upward * up()) + half_depth() * backward(),
            -backward()};
  return {viewpoint(), (across * right() + upward * up() - backward()).normalized()};
}

Vec2f Camera::pixel(const Vec3f& point, Size size) const {
  const Eigen::Vector4f clip = projection(size) * view() * point.homogeneous();
  return {(clip.x() / clip.w() + 1) / 2 * static_cast<float>(size.width),
          (1 - clip.y() / clip.w()) / 2 * static_cast<float>(size.height)};
}

Vec3f Camera::drag(float x, float y, Size size, const Vec3f& point) const {
  const Ray through = ray(x, y, size);
  const float depth = (point - through.origin).dot(backward()) / through.direction.dot(backward());
  return through.origin + depth * through.direction;
}

Vec3f direction_of(StandardView view) {
  Camera camera;
  const ViewAngles angles = angles_of(view);
  camera.look(static_cast<float>(angles.azimuth) * degree, static_cast<float>(angles.elevation) * degree);
  return camera.backward();
}

}  // namespace heml::render
