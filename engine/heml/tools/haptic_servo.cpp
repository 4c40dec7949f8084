#include <Eigen/Eigenvalues>
#include <algorithm>
#include <heml/tools/haptic_servo.hpp>

namespace heml {
namespace {

constexpr double min_travel = 1e-6;  // m: shorter displacements do not update the stiffness

/// The symmetric part of B with eigenvalues clamped to [0, max_stiffness].
Mat3 bounded(const Mat3& B, double max_stiffness) {
  const Eigen::SelfAdjointEigenSolver<Mat3> parts((B + B.transpose()) / 2);
  const Vec3 values = parts.eigenvalues().cwiseMax(0).cwiseMin(max_stiffness);
  return parts.eigenvectors() * values.asDiagonal() * parts.eigenvectors().transpose();
}

}  // namespace

void HapticServo::update(const ToolContact& state) {
  if (touching_) {
    correction_ = modelled(state.tool) - state.force;
    between_ = state.time - last_.time;
    if (const Vec3 displacement = state.tool - last_.tool; displacement.norm() > min_travel)
      broyden_ +=
          (state.force - last_.force - broyden_ * displacement) * displacement.transpose() / displacement.squaredNorm();
    stiffness_ = bounded(broyden_, limits_.max_stiffness);
  } else {
    correction_ = -state.force;  // blend from zero force
    between_ = 0;
    broyden_ = stiffness_ = Mat3::Zero();
  }
  touching_ = true;
  since_ = 0;
  last_ = state;
}

void HapticServo::release() { touching_ = false; }

/// The force on the tissue with the tool at x, N. Blends to a new state within the time between the last two.
Vec3 HapticServo::modelled(const Vec3& x) const {
  const double gone_over = between_ > 0 ? std::min(1.0, since_ / between_) : 1;
  return last_.force + stiffness_ * (x - last_.tool) + (1 - gone_over) * correction_;
}

/// The force was constant over the displacement, so its work is exact.
void HapticServo::limit_energy(const Vec3& displacement, double seconds) {
  energy_ -= last_force_.dot(displacement);
  damping_ = 0;
  if (const double square = displacement.squaredNorm() / seconds; energy_ < 0 && square > 0)
    damping_ = std::min(-energy_ / square, limits_.damping);
}

Vec3 HapticServo::serve(const Vec3& x, double seconds) {
  const Vec3 displacement = has_served_ ? Vec3(x - handle_) : Vec3(Vec3::Zero());
  limit_energy(displacement, seconds);
  Vec3 force = touching_ ? Vec3(-modelled(x)) : Vec3(Vec3::Zero());
  force -= damping_ * displacement / seconds;
  if (const double size = force.norm(); size > limits_.force) force *= limits_.force / size;
  since_ += seconds;
  handle_ = x, last_force_ = force, has_served_ = true;
  return force;
}

}  // namespace heml
