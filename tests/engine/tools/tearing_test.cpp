#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <heml/tools/tearing.hpp>

#include "support.hpp"

namespace heml::tearing_test {

using namespace heml::test;

namespace {

constexpr double limit = 1.5;

/// Two tetrahedra on both sides of the face of the nodes 0, 1 and 2, in z = 0; as many such pairs as there are places.
struct Pairs {
  TetMesh mesh;
  std::vector<Vec3> x;

  explicit Pairs(int count) {
    for (int k = 0; k < count; ++k) {
      const int n = 5 * k;
      for (const Vec3& X : {Vec3(0, 0, 0), Vec3(1, 0.1, 0), Vec3(0.2, 1, 0), Vec3(0.4, 0.3, 0.9), Vec3(0.3, 0.4, -1.1)})
        mesh.nodes.push_back(X + Vec3(5.0 * k, 0, 0));
      mesh.tets.push_back({n, n + 1, n + 2, n + 3});
      mesh.tets.push_back({n, n + 2, n + 1, n + 4});
    }
    mesh.regions.assign(mesh.tets.size(), 0);
    x = mesh.nodes;
  }

  void deform(int pair, const Mat3& F) {
    for (int n = 5 * pair; n < 5 * pair + 5; ++n)
      x[static_cast<std::size_t>(n)] = F * mesh.nodes[static_cast<std::size_t>(n)];
  }

  std::vector<TearOpening> openings(const std::vector<int>& constrained = {}) const {
    ThreadTeam team(1);
    Tearing tearing({limit}, mesh, full_topology(mesh));
    return tearing.openings(
        mesh, x, [&](int n) { return std::find(constrained.begin(), constrained.end(), n) != constrained.end(); },
        team);
  }
};

Mat3 stretched(double by, const Vec3& direction = Vec3::UnitZ()) {
  return Mat3::Identity() + (by - 1) * direction * direction.transpose();
}

}  // namespace

TEST_CASE("an element opens where its largest principal stretch passes the limit, whichever way it is turned") {
  std::mt19937_64 random(41);
  for (int k = 0; k < 50; ++k) {
    Pairs pair(1);
    const Mat3 R = random_rotation(random);
    const Vec3 direction = (Vec3::UnitZ() + random_vector(random, 0.2)).normalized();
    const Vec3 across = direction.unitOrthogonal();
    const Mat3 narrow = stretched(uniform(random, 0.3, 1.4), across);
    pair.deform(0, R * stretched(limit * (1 - 1e-9), direction) * narrow);
    CHECK(pair.openings().empty());
    pair.deform(0, R * stretched(limit * (1 + 1e-9), direction) * narrow);
    const auto openings = pair.openings();
    REQUIRE(openings.size() == 1);
    CHECK(openings[0].node == 0);  // of three alike the first
    CHECK(std::abs(openings[0].plane_normal.dot(direction)) == doctest::Approx(1).epsilon(1e-6));
    CHECK(openings[0].plane_normal.norm() == doctest::Approx(1));
  }
}

TEST_CASE("an element pushed flat or turned over tears by its stretch alone") {
  Pairs pair(1);
  pair.deform(0, Vec3(1.4, 1.4, 0.01).asDiagonal());
  CHECK(pair.openings().empty());
  pair.deform(0, Vec3(1.4, 1.4, -1.4).asDiagonal());
  CHECK(pair.openings().empty());
  pair.deform(0, Vec3(1, 1, -1.6).asDiagonal());
  CHECK(pair.openings().size() == 1);
}

TEST_CASE("held nodes do not open, and nodes that have elements on one side alone cannot") {
  Pairs pair(1);
  pair.deform(0, stretched(1.6));
  CHECK(pair.openings({0})[0].node == 1);
  CHECK(pair.openings({0, 1})[0].node == 2);
  CHECK(pair.openings({0, 1, 2}).empty());  // 3 and 4 have one element each
}

TEST_CASE("the element that is stretched the most lets go alone, unless others are overdue") {
  Pairs pairs(3);
  pairs.deform(0, stretched(1.6));
  pairs.deform(1, stretched(1.8));
  pairs.deform(2, stretched(1.7));
  REQUIRE(pairs.openings().size() == 1);
  CHECK(pairs.openings()[0].node == 5);
  pairs.deform(2, stretched(limit * Tearing::overload + 0.01));
  pairs.deform(1, stretched(limit * Tearing::overload - 0.01));
  REQUIRE(pairs.openings().size() == 1);
  CHECK(pairs.openings()[0].node == 10);
  pairs.deform(1, stretched(limit * Tearing::overload + 0.02));
  const auto both = pairs.openings();
  REQUIRE(both.size() == 2);
  CHECK(both[0].node == 5);
  CHECK(both[1].node == 10);
}

TEST_CASE("places that are no numbers do not tear") {
  Pairs pair(1);
  pair.deform(0, stretched(1.6));
  pair.x[3].x() = pair.x[4].x() = std::nan("");
  CHECK(pair.openings().empty());
}

}  // namespace heml::tearing_test
