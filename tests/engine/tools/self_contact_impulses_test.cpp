#include <doctest/doctest.h>

#include <cmath>
#include <heml/tools/contact_motion.hpp>
#include <heml/tools/self_contact_impulses.hpp>

#include "engine/tools/small_tets.hpp"

namespace heml::self_contact_impulses_test {

using namespace heml::test;

namespace {

constexpr double h = 0.01;  // s

/// Two tetrahedra that fly at each other, their nodes with a mass each.
struct Collision {
  TetMesh mesh;
  SelfContact contact;
  std::vector<double> before, after, v, inverse_mass;
  SelfContactImpulses<double> impulses;

  Collision(std::mt19937_64& random, double friction, double gap)
      : mesh(two(random, gap)), contact(SelfContactSettings{friction}, mesh) {
    for (std::size_t n = 0; n < 8; ++n) {
      const Vec3 toward(0, 0, n < 4 ? 0.5 : -0.5);
      const Vec3 velocity = (20 * toward + random_vector(random, 0.5)) * (n < 4 ? 1 : 0.7) + Vec3(n < 4 ? 3 : 0, 0, 0);
      before.insert(before.end(), mesh.nodes[n].begin(), mesh.nodes[n].end());
      v.insert(v.end(), velocity.begin(), velocity.end());
      inverse_mass.push_back(1 / uniform(random, 0.2, 4));
    }
    after = before;
    for (std::size_t i = 0; i < after.size(); ++i) after[i] += h * v[i];
  }

  /// A corner of the upper one over the middle of the lower one's upper face.
  static TetMesh two(std::mt19937_64& random, double gap) {
    TetMesh mesh;
    add_tet(mesh, {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0), Vec3(0, 0, -2)});
    const Vec3 corner(uniform(random, -0.2, 0.2), uniform(random, -0.5, 0), gap);
    add_tet(mesh, {corner, corner + Vec3(-1, -1, 2), corner + Vec3(1, -1, 2), corner + Vec3(0, 1, 2)});
    return mesh;
  }

  void meet() { impulses.find_pairs(contact, h, inverse_mass, before.data(), after.data()); }

  Vec3 momentum() const {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < 8; ++n) sum += at(v.data(), n) / inverse_mass[static_cast<std::size_t>(n)];
    return sum;
  }
  Vec3 moment(const std::vector<double>& x) const {
    Vec3 sum = Vec3::Zero();
    for (int n = 0; n < 8; ++n)
      sum += at(x.data(), n).cross(at(v.data(), n)) / inverse_mass[static_cast<std::size_t>(n)];
    return sum;
  }
  double energy() const {
    double sum = 0;
    for (int n = 0; n < 8; ++n) sum += at(v.data(), n).squaredNorm() / inverse_mass[static_cast<std::size_t>(n)] / 2;
    return sum;
  }
  /// Of the corner above the face, as they would lie after the step.
  double gap_after() const { return before[3 * 4 + 2] - plane(before) + h * (v[3 * 4 + 2] - plane(v)); }
  /// A quantity's third component where the corner's foot is on the face.
  double plane(const std::vector<double>& q) const {
    const double x = before[12], y = before[13];
    const double c = (y + 1) / 2, b = (x + 1 - c) / 2;  // weights of the corners 2 and 1
    return (1 - b - c) * q[2] + b * q[5] + c * q[8];
  }
};

}  // namespace

TEST_CASE("tissue that would cross tissue comes to lie on it, and momentum and its moment stay") {
  std::mt19937_64 random(31);
  for (int k = 0; k < 50; ++k) {
    CAPTURE(k);
    Collision two(random, 0, uniform(random, 0.01, 0.05));
    REQUIRE(two.gap_after() < -0.01);
    const Vec3 momentum = two.momentum(), moment = two.moment(two.before);
    const double energy = two.energy();
    two.meet();
    REQUIRE_FALSE(two.impulses.empty());
    two.impulses.solve(two.v.data());
    CHECK(std::abs(two.gap_after()) < 1e-9);
    CHECK((two.momentum() - momentum).norm() < 1e-13 * momentum.norm() + 1e-12);
    CHECK((two.moment(two.before) - moment).norm() < 1e-11);
    CHECK(two.energy() < energy);
  }
}

TEST_CASE("one pair's impulse is what it lacks in speed by its inverse mass") {
  std::mt19937_64 random(32);
  Collision two(random, 0, 0.02);
  const auto first = two.v;
  const double c = (two.before[13] + 1) / 2, b = (two.before[12] + 1 - c) / 2;
  const std::array<double, 8> weights = {b + c - 1, -b, -c, 0, 1, 0, 0, 0};
  double light = 0;
  for (std::size_t n = 0; n < 8; ++n) light += weights[n] * weights[n] * two.inverse_mass[n];
  const double impulse = -two.gap_after() / h / light;
  two.meet();
  two.impulses.solve(two.v.data());
  for (std::size_t n = 0; n < 8; ++n) {
    CHECK(two.v[3 * n] == first[3 * n]);
    CHECK(two.v[3 * n + 1] == first[3 * n + 1]);
    CHECK(two.v[3 * n + 2] == doctest::Approx(first[3 * n + 2] + weights[n] * impulse * two.inverse_mass[n]));
  }
  double normal = 0;
  ContactReport report;
  two.impulses.publish(0.5, normal, report);
  CHECK(normal == doctest::Approx(impulse / 2));
  CHECK(report.work == 0);
}

TEST_CASE("once met, tissue rubs: friction is at most Coulomb's, and momentum stays") {
  std::mt19937_64 random(33);
  int sticks = 0;
  for (int k = 0; k < 60; ++k) {
    CAPTURE(k);
    const double friction = uniform(random, 0.02, 1.2);
    Collision two(random, friction, 0.02);
    two.meet();
    two.impulses.solve(two.v.data());
    // The other half of the step: pairs that were pushed, as they lie now, are not to come nearer.
    auto x = two.before;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += h * two.v[i];
    for (std::size_t n = 0; n < 4; ++n) two.v[3 * n + 2] += 2, two.v[3 * (n + 4) + 2] -= 1;
    two.impulses.begin_second_half(two.inverse_mass, x.data());
    const auto first = two.v;
    const Vec3 momentum = two.momentum();
    const double energy = two.energy();
    two.impulses.solve(two.v.data());
    CHECK((two.momentum() - momentum).norm() < 1e-12 * momentum.norm() + 1e-12);
    CHECK(two.energy() <= energy);
    // All of what the corner got is the pair's impulse.
    const Vec3 impulse = (at(two.v.data(), 4) - at(first.data(), 4)) / two.inverse_mass[4];
    two.impulses.each_contact_point([&](const ContactPoint& point) {
      const double normal = point.normal.dot(impulse), along = (impulse - normal * point.normal).norm();
      CHECK(normal > 0);
      CHECK(along <= friction * normal * (1 + 1e-9));
      const Vec3 u = at(two.v.data(), point);
      CHECK(point.normal.dot(u) > -1e-6);
      const double slides = (u - point.normal.dot(u) * point.normal).norm();
      if (along < friction * normal * (1 - 1e-6)) CHECK(slides < 1e-6);
      sticks += slides < 1e-6 ? 1 : 0;
    });
    double normal = 0;
    ContactReport report;
    two.impulses.publish(1, normal, report);
    CHECK(report.work <= 0);
  }
  CHECK(sticks > 5);
  CHECK(sticks < 55);
}

TEST_CASE("what is held is not moved, and two held pieces of tissue are no pair") {
  std::mt19937_64 random(34);
  Collision two(random, 0, 0.02);
  for (std::size_t n = 0; n < 4; ++n) two.inverse_mass[n] = 0;
  const auto first = two.v;
  // The lower one stands still.
  for (std::size_t i = 0; i < 12; ++i) two.v[i] = 0, two.after[i] = two.before[i];
  two.meet();
  two.impulses.solve(two.v.data());
  for (std::size_t i = 0; i < 12; ++i) CHECK(two.v[i] == 0);
  CHECK(two.v[14] == doctest::Approx(-0.02 / h));
  two.v = first;
  two.inverse_mass.assign(8, 0);
  two.meet();
  CHECK(two.impulses.empty());
}

TEST_CASE("a pair that slides onto what is held is left in the second half of a step") {
  std::mt19937_64 random(36);
  Collision two(random, 0.3, 0.02);
  for (std::size_t n = 0; n < 8; ++n)
    if (n != 2) two.inverse_mass[n] = 0;  // of the lower face, one corner is free
  two.meet();
  two.impulses.solve(two.v.data());
  REQUIRE_FALSE(two.impulses.empty());
  two.after = two.before;
  two.after[3 * 4 + 1] = -1;  // over the edge opposite to the free corner
  const auto before = two.v;
  two.impulses.begin_second_half(two.inverse_mass, two.after.data());
  two.impulses.solve(two.v.data());
  CHECK(two.v == before);
}

TEST_CASE("remembered impulses start the rounds where the last step ended") {
  std::mt19937_64 random(35);
  for (int k = 0; k < 20; ++k) {
    CAPTURE(k);
    Collision two(random, 0.3, 0.02);
    const auto first = two.v;
    two.meet();
    two.impulses.solve(two.v.data());
    const int cold = two.impulses.rounds();
    const auto solved = two.v;
    std::vector<RememberedPair> known;
    two.impulses.remember_first_half(two.after.data(), known);
    CHECK_FALSE(known.empty());

    two.v = first;
    two.impulses.find_pairs(two.contact, h, two.inverse_mass, two.before.data(), two.after.data(), known);
    two.impulses.warm_start(two.v.data());
    two.impulses.solve(two.v.data());
    CHECK(two.impulses.rounds() <= std::min(cold, 4));
    CHECK(two.impulses.residual() < 1e-4);
    for (std::size_t i = 0; i < solved.size(); ++i) CHECK(std::abs(two.v[i] - solved[i]) < 1e-3);
  }
}

TEST_CASE("remembered impulses that would add energy are not applied") {
  std::mt19937_64 random(36);
  Collision two(random, 0, 0.02);
  two.meet();
  two.impulses.solve(two.v.data());
  std::vector<RememberedPair> known;
  two.impulses.remember_first_half(two.after.data(), known);
  for (RememberedPair& pair : known) pair.halves[0].normal *= 10;
  for (std::size_t i = 0; i < two.v.size(); ++i) two.v[i] *= 1e-3;  // nearly at rest
  const double energy = two.energy();
  two.impulses.find_pairs(two.contact, h, two.inverse_mass, two.before.data(), two.after.data(), known);
  two.impulses.warm_start(two.v.data());
  two.impulses.solve(two.v.data());
  CHECK(two.energy() <= energy * (1 + 1e-12));
}

}  // namespace heml::self_contact_impulses_test
