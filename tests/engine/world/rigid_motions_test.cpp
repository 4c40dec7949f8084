#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <heml/world/rigid_motions.hpp>

#include "world_support.hpp"

namespace heml::rigid_motions_test {

using namespace heml::test;

namespace {

/// Two boxes that share no node, with random masses; the second is held at one coordinate.
struct Boxes {
  TetMesh mesh = make_box(Vec3::Ones(), {2, 1, 1});
  std::size_t first = mesh.nodes.size();
  Vector mass, x;

  explicit Boxes(std::mt19937_64& random, bool holds = true) {
    add(mesh, make_box(Vec3::Ones(), {1, 1, 1}), Eigen::Isometry3d(Eigen::Translation3d(3, 0, 0)));
    mass = Vector(3 * static_cast<Eigen::Index>(mesh.nodes.size()));
    x = mass;
    for (std::size_t n = 0; n < mesh.nodes.size(); ++n) {
      mass.segment<3>(3 * static_cast<int>(n)).setConstant(uniform(random, 1, 2));
      x.segment<3>(3 * static_cast<int>(n)) = mesh.nodes[n];
    }
    if (holds) mass[mass.size() - 1] = 0;
  }
  Vector shaken(std::mt19937_64& random, double by) const {
    Vector result = x;
    for (double& value : result) value += by * uniform(random, -1, 1);
    return result;
  }
};

/// Σ m v, then Σ m x × v, of nodes 0 .. first.
Eigen::Matrix<double, 6, 1> momentum(const Boxes& boxes, const Vector& x, const Vector& v) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (int n = 0; n < static_cast<int>(boxes.first); ++n) {
    sum.head<3>() += boxes.mass[3 * n] * v.segment<3>(3 * n);
    sum.tail<3>() += boxes.mass[3 * n] * Vec3(x.segment<3>(3 * n)).cross(Vec3(v.segment<3>(3 * n)));
  }
  return sum;
}

}  // namespace

TEST_CASE("the rigid part of velocities has their momentum, the rest none, and a held part has no rigid motion") {
  std::mt19937_64 random(5);
  const Boxes boxes(random);
  const RigidMotions motions(boxes.mesh, {}, boxes.mass);
  const Vector x = boxes.shaken(random, 0.1), v = boxes.shaken(random, 1);
  const Vector rigid = motions.velocity(x, v);
  const auto all = momentum(boxes, x, v);
  CHECK((momentum(boxes, x, rigid) - all).norm() < 1e-12 * all.norm());
  CHECK(rigid.tail(rigid.size() - 3 * static_cast<Eigen::Index>(boxes.first)).isZero(0));
  const auto distance_grows = [&](int a, int b) {
    return Vec3(x.segment<3>(3 * a) - x.segment<3>(3 * b)).dot(Vec3(rigid.segment<3>(3 * a) - rigid.segment<3>(3 * b)));
  };
  for (int n = 1; n < static_cast<int>(boxes.first); ++n) CHECK(std::abs(distance_grows(0, n)) < 1e-12);
}

TEST_CASE("a body that has turned and moved as a whole is found where it is, a deformed one near") {
  std::mt19937_64 random(6);
  const Boxes boxes(random);
  const RigidMotions motions(boxes.mesh, {}, boxes.mass);
  const Mat3 turn = Eigen::AngleAxisd(2.5, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  Vector to = boxes.x;
  for (int n = 0; n < static_cast<int>(boxes.first); ++n)
    to.segment<3>(3 * n) = turn * Vec3(boxes.x.segment<3>(3 * n)) + Vec3(1, -2, 3);
  CHECK((motions.moved(boxes.x, to) - to).norm() < 1e-12);
  Vector beside = to;
  for (double& value : beside) value += 0.05 * uniform(random, -1, 1);
  const Vector found = motions.moved(boxes.x, beside);
  CHECK((found - to).norm() < 0.5 * (beside - to).norm() + (beside - to).tail(24).norm());
  CHECK(found.tail(24) == boxes.x.tail(24));  // the held one
}

TEST_CASE("a body slides past the force that stops it") {
  std::mt19937_64 random(7);
  const Boxes boxes(random, false);
  const RigidMotions motions(boxes.mesh, {}, boxes.mass);
  Vector to = boxes.x, force = Vector::Zero(boxes.x.size());
  for (int n = 0; n < static_cast<int>(boxes.first); ++n) to.segment<3>(3 * n) += Vec3(2, -1, 0.5);
  force[1] = 3;  // up, on one node
  const Vector slid = motions.slid(boxes.x, to, force);
  for (int n = 0; n < static_cast<int>(boxes.first); ++n)
    CHECK((slid.segment<3>(3 * n) - boxes.x.segment<3>(3 * n) - Vec3(2, 0, 0.5)).norm() < 1e-12);
  CHECK(slid.tail(24) == boxes.x.tail(24));
  const std::vector<double> heavy(boxes.mesh.nodes.size(), 0.5);  // others than those that resist
  CHECK(motions.weight_work(heavy, Vec3(0, -9.81, 0), boxes.x, to) ==
        doctest::Approx(9.81 * 0.5 * static_cast<double>(boxes.first)));
}

}  // namespace heml::rigid_motions_test
