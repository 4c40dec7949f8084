#include <app/window/arrow_drag.hpp>
#include <cmath>
#include <utility>

namespace heml::window {
namespace {

/// To four digits of its size: a mouse tells no more.
Vec3 rounded(const Vec3& value) {
  const double size = value.norm();
  if (!(size > 0)) return value;
  const double step = std::pow(10.0, std::floor(std::log10(size)) - 3);
  return (value / step).array().round().matrix() * step;
}

}  // namespace

Vec3f Arrow::tip() const {
  const double size = value.norm();
  return size > 0 ? Vec3f(from + length * (value / size).cast<float>()) : from;
}

bool ArrowDrag::is_on_tip(const Arrow& arrow, const render::Vec2f& at, float reach,
                          const panel::CameraController& controller) {
  return (controller.pixel(arrow.tip()) - at).norm() < reach;
}

double ArrowDrag::scale() const {
  const double size = arrow_->value.norm();
  return (size > 0 ? size : arrow_->usual) / static_cast<double>(arrow_->length);
}

void ArrowDrag::move(const render::Vec2f& at, bool along_axis, const panel::CameraController& controller) {
  if (!arrow_) return;
  const Vec3f point = controller.drag(at, tip_);
  if (!point.allFinite()) return;
  Vec3 value = scale() * (point - arrow_->from).cast<double>();
  if (along_axis) {
    int axis = 0;
    value.cwiseAbs().maxCoeff(&axis);
    value = Vec3(value[axis] * Vec3::Unit(axis));
  }
  moved_ = rounded(value);
}

Vec3f ArrowDrag::tip() const { return arrow_->from + (value() / scale()).cast<float>(); }

std::optional<Vec3> ArrowDrag::release() {
  arrow_.reset();
  return std::exchange(moved_, std::nullopt);
}

}  // namespace heml::window
