#include <doctest/doctest.h>

#include <cmath>
#include <heml/tools/grasp.hpp>

namespace heml::grasp_test {

namespace {
const std::vector<Vec3> rest = {{0, 0, 0}, {0.01, 0, 0}, {0.05, 0, 0}, {0, 0.01, 0}};
const std::vector<double> x = {0, 0, 0, 0.01, 0, 0, 0.05, 0, 0, 0, 0.01, 0};
const std::vector<double> still(12, 0.0);
const std::vector<int> all = {0, 1, 2, 3};
}  // namespace

TEST_CASE("a grasp takes the free nodes within its radius and pulls nothing before it is moved") {
  GraspSpring<double> grasp({}, 0, 0.02, all, rest, x.data(), {1, 1, 1, 0}, 100, 10);  // node 3 is constrained
  CHECK_FALSE(grasp.empty());
  CHECK(grasp.force(x.data(), still.data()).norm() <= 1e-12);
  CHECK(grasp.grip(x.data()).norm() <= 1e-15);
  grasp.move(Vec3(0, 0, 0.001));
  std::vector<double> f(12, 0.0);
  grasp.add_forces(x.data(), still.data(), f.data());
  CHECK(f[2] == doctest::Approx(100 * 100 * 0.001));
  CHECK(f[5] == doctest::Approx(100 * 100 * 0.001 * 0.75 * 0.75));  // (1 − (1/2)²)²
  CHECK(f[8] == 0);
  CHECK(f[11] == 0);
  CHECK(grasp.force(x.data(), still.data()).z() == doctest::Approx(f[2] + f[5]));
}

TEST_CASE("a grasp of constrained nodes only is empty") {
  CHECK(GraspSpring<double>({}, 3, 0.001, all, rest, x.data(), {1, 1, 1, 0}, 100, 10).empty());
}

TEST_CASE("a grasped mass follows the tool without overshoot") {
  const double omega = 50, h = 1e-4;
  std::vector<double> at = {0, 0, 0}, v = {0, 0, 0};
  GraspSpring<double> grasp({}, 0, 0, std::vector<int>{0}, {Vec3::Zero()}, at.data(), {2.0}, omega, 10);
  grasp.move(Vec3(1, 0, 0));
  double largest = 0;
  for (int k = 0; k < 5000; ++k) {
    std::vector<double> f(3, 0.0);
    grasp.add_forces(at.data(), v.data(), f.data());
    v[0] += h * 2.0 * f[0];
    at[0] += h * v[0];
    largest = std::max(largest, at[0]);
    if (k == 999) CHECK(at[0] == doctest::Approx(1 - (1 + omega * 0.1) * std::exp(-omega * 0.1)).epsilon(0.01));
  }
  CHECK(largest <= 1 + 1e-9);
  CHECK(at[0] == doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("a grasp moves nodes no faster than it says") {
  const double omega = 50, h = 1e-4;
  std::vector<double> at = {0, 0, 0}, v = {0, 0, 0};
  GraspSpring<double> grasp({}, 0, 0, std::vector<int>{0}, {Vec3::Zero()}, at.data(), {2.0}, omega, 0.5);
  double told = 0, fastest = 0;
  for (int k = 0; k < 4000; ++k) {
    if (k == 1000) grasp.move(Vec3(1, 0, 0));                      // jumps out of reach
    if (k > 2000) grasp.move(grasp.target() + Vec3(0, 2 * h, 0));  // 2 m/s
    told = std::max(told, grasp.speed_at_most(at.data()));
    std::vector<double> f(3, 0.0);
    grasp.add_forces(at.data(), v.data(), f.data());
    for (std::size_t i = 0; i < 3; ++i) {
      v[i] += h * 2.0 * f[i];
      at[i] += h * v[i];
    }
    const double speed = std::hypot(v[0], v[1], v[2]);
    CHECK(speed <= told * (1 + 1e-9));
    fastest = std::max(fastest, speed);
    if (k == 1000) CHECK(told == doctest::Approx(omega * 0.5 / 2));
    if (k == 3999) CHECK(speed == doctest::Approx(grasp.speed_at_most(at.data())).epsilon(0.01));  // drawn steadily
  }
  CHECK(fastest > told / 2);
}

TEST_CASE("beyond its reach a grasp slips and the force stays constant") {
  GraspSpring<double> grasp({}, 0, 0, std::vector<int>{0}, {Vec3::Zero()}, x.data(), {1.0}, 100, 0.02);
  grasp.move(Vec3(0.015, 0, 0));
  CHECK(grasp.force(x.data(), still.data()).x() == doctest::Approx(1e4 * 0.015));
  grasp.move(Vec3(0, 5, 0));
  CHECK(grasp.force(x.data(), still.data()).y() == doctest::Approx(1e4 * 0.02));
}

}  // namespace heml::grasp_test
