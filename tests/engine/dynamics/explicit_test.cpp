#include <doctest/doctest.h>

#include <cmath>
#include <heml/dynamics/prescribed_motion.hpp>
#include <heml/dynamics/symplectic_euler.hpp>
#include <heml/dynamics/verlet.hpp>
#include <numbers>

namespace heml::explicit_test {

namespace {

/// Position and velocity at t = 1 after n steps of one mass on a spring, x'' = −ω²x − αx', released at x = 1 from rest.
template <class Method>
std::pair<double, double> oscillator(double omega, double damping, int n) {
  const double h = 1.0 / n, inverse_mass[3] = {1, 1, 1};
  double x[3] = {1, 0, 0}, v[3] = {0, 0, 0}, f[3] = {-omega * omega, 0, 0};
  for (int k = 0; k < n; ++k) {
    Method::first_half_step(h, damping, {inverse_mass, f, x, v, x, v}, 0, 3);
    f[0] = -omega * omega * x[0];
    Method::second_half_step(h, damping, inverse_mass, f, v, 0, 3);
  }
  return {x[0], v[0]};
}

std::pair<double, double> exact(double omega, double damping) {
  const double a = damping / 2, w = std::sqrt(omega * omega - a * a), e = std::exp(-a);
  return {e * (std::cos(w) + a / w * std::sin(w)), -e * (omega * omega / w) * std::sin(w)};
}

template <class Method>
double order(double omega, double damping) {
  const auto error = [&](int n) {
    const auto [x, v] = oscillator<Method>(omega, damping, n);
    const auto [X, V] = exact(omega, damping);
    return std::hypot(x - X, (v - V) / omega);
  };
  return std::log2(error(400) / error(800));
}

}  // namespace

TEST_CASE("symplectic Euler is of first order and Verlet of second, damped or not") {
  for (const double damping : {0.0, 3.0}) {
    CHECK(order<SymplecticEuler<double>>(7, damping) == doctest::Approx(1).epsilon(0.05));
    CHECK(order<Verlet<double>>(7, damping) == doctest::Approx(2).epsilon(0.02));
  }
}

TEST_CASE("both methods are stable up to 2/omega, with heavy damping too, and not beyond") {
  const int n = 5000;
  for (const double damping : {0.0, 50.0}) {
    CHECK(std::abs(oscillator<SymplecticEuler<double>>(1.99 * n, damping, n).first) < 1e3);
    CHECK(std::abs(oscillator<Verlet<double>>(1.99 * n, damping, n).first) < 1e3);
  }
  CHECK_FALSE(std::abs(oscillator<SymplecticEuler<double>>(2.01 * n, 0, n).first) < 1e10);
  CHECK_FALSE(std::abs(oscillator<Verlet<double>>(2.01 * n, 0, n).first) < 1e10);
}

TEST_CASE("a moved node follows its ramp, and velocity and acceleration are its derivatives") {
  const PrescribedMotion motion{Vec3(0.05, 0, 0.01), Vec3(1, 0, 0), Vec3(0, 0.1, 0), std::numbers::pi / 2, {0, 2.0}};
  const Vec3 X(0.3, 0.2, 0);
  CHECK((motion(X, 0).x - X).norm() <= 1e-15);
  // Arm (0.3, 0.1, 0) rotated by 90° about x: (0.3, 0, 0.1); then origin and translation.
  CHECK((motion(X, 2).x - Vec3(0.35, 0.1, 0.11)).norm() <= 1e-15);
  CHECK((motion(X, 9).x - motion(X, 2).x).norm() == 0);
  CHECK(motion(X, 9).v.norm() == 0);
  const double t = 0.7, h = 1e-5;
  CHECK((motion(X, t).v - (motion(X, t + h).x - motion(X, t - h).x) / (2 * h)).norm() <= 1e-9);
  CHECK((motion(X, t).a - (motion(X, t + h).v - motion(X, t - h).v) / (2 * h)).norm() <= 1e-9);
  const PrescribedMotion at_once{Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3::Zero(), 0};
  CHECK((at_once(X, 0).x - X - Vec3(1, 0, 0)).norm() == 0);
}

}  // namespace heml::explicit_test
