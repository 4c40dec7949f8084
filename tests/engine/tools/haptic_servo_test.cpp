#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <heml/tools/haptic_servo.hpp>
#include <vector>

namespace heml::haptic_servo_test {
namespace {

constexpr double turn = 1e-3, tick = 1.0 / 60;  // s

/// Linear anisotropic spring: force (N) of the tool on the tissue at x (m).
Vec3 spring(const Vec3& x) { return Vec3(200 * x.x() + 50 * x.y(), 50 * x.x() + 120 * x.y(), 40 * x.z()); }

Vec3 handle_at(double t) { return 0.01 * Vec3(std::sin(9 * t), std::cos(5 * t), std::sin(7 * t + 1)); }

struct Errors {
  double modelled = 0, held = 0;  ///< N, rms, of the model and of the last state's force kept constant
};

/// A handle on a prescribed path; states come one tick late, as from an engine that uses its whole tick.
Errors follow(const HapticLimits& limits) {
  HapticServo servo(limits);
  Vec3 held = Vec3::Zero();
  Errors errors;
  int counted = 0;
  long seen = -1;
  for (int k = 0; k < 3000; ++k) {
    const double t = k * turn;
    if (const long now = static_cast<long>(t / tick); now > seen) {
      seen = now;
      const double then = static_cast<double>(now - 1) * tick;
      held = spring(handle_at(then));
      servo.update({static_cast<double>(now) * tick, handle_at(then), held});
    }
    const Vec3 felt = servo.serve(handle_at(t), turn);
    if (t < 1) continue;  // Broyden's update converges
    errors.modelled += (felt + spring(handle_at(t))).squaredNorm();
    errors.held += (held - spring(handle_at(t))).squaredNorm();
    ++counted;
  }
  return {std::sqrt(errors.modelled / counted), std::sqrt(errors.held / counted)};
}

struct Bounce {
  double energy = 0, highest = 0;  ///< J; m, of the last second
};

/// A handle of 100 g that bounces on a stiff floor whose states are two ticks late.
Bounce drop(const HapticLimits& limits) {
  HapticServo servo(limits);
  const double stiffness = 400, mass = 0.1;
  std::vector<double> displacement;
  double z = 0.02, v = 0;
  Bounce result;
  long seen = -1;
  for (int k = 0; k < 6000; ++k) {
    displacement.push_back(z);
    if (const long now = static_cast<long>(k * turn / tick); now > seen) {
      seen = now;
      const double then = displacement[static_cast<std::size_t>(std::max(0l, k - static_cast<long>(2 * tick / turn)))];
      servo.update({static_cast<double>(now) * tick, Vec3(0, 0, then), Vec3(0, 0, std::min(0.0, stiffness * then))});
    }
    const double force = servo.serve(Vec3(0, 0, z), turn).z();
    v += turn * (force / mass - 9.81);
    z += turn * v;
    if (k > 5000) result.highest = std::max(result.highest, std::abs(z));
  }
  result.energy = servo.energy();
  return result;
}

}  // namespace

TEST_CASE("between states a hand feels the estimated stiffness and no steps of force") {
  const Errors errors = follow({1000, 100, 20});
  CHECK(errors.held > 0.3);
  CHECK(errors.modelled < errors.held / 4);
}

TEST_CASE("the stiffness of the model is symmetric and no more than the device can hold") {
  HapticServo servo({150, 100, 20});
  for (int k = 0; k < 40; ++k) {
    const Vec3 x = handle_at(k * tick);
    servo.update({k * tick, x, spring(x)});
    const Mat3& B = servo.stiffness();
    CHECK((B - B.transpose()).norm() < 1e-9);
    const Vec3 values = Eigen::SelfAdjointEigenSolver<Mat3>(B).eigenvalues();
    CHECK(values.minCoeff() >= -1e-9);
    CHECK(values.maxCoeff() <= 150 + 1e-9);
  }
}

TEST_CASE("late states add energy to a hand, and the added damping dissipates it") {
  HapticLimits off{1000, 100, 0}, on{1000, 100, 20};
  const Bounce wild = drop(off), tame = drop(on);
  CHECK(wild.energy < -0.01);
  CHECK(wild.highest > 0.04);  // dropped from 0.02
  CHECK(tame.energy > -0.002);
  CHECK(tame.highest < 0.04);
}

TEST_CASE("a hand without a grasp feels no force, and grasping causes no step of force") {
  HapticServo servo;
  CHECK(servo.serve(Vec3(1, 2, 3), turn).norm() == 0);
  servo.update({0, Vec3::Zero(), Vec3(1, 0, 0)});
  servo.update({tick, Vec3::Zero(), Vec3(1, 0, 0)});
  const double first = servo.serve(Vec3::Zero(), turn).norm();
  CHECK(first < 1.0 + 1e-12);
  servo.release();
  CHECK(servo.serve(Vec3::Zero(), turn).norm() == 0);
}

TEST_CASE("no force is greater than the device can give") {
  HapticServo servo({1000, 4, 20});
  servo.update({0, Vec3::Zero(), Vec3(30, 40, 0)});
  const Vec3 force = servo.serve(Vec3::Zero(), turn);
  CHECK(force.norm() == doctest::Approx(4));
  CHECK(force.x() == doctest::Approx(-2.4));
}

}  // namespace heml::haptic_servo_test
