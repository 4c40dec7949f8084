// How far nodes of a skin move, within their bodies and between them.
#include <doctest/doctest.h>

#include <heml/tools/contact_travel.hpp>

#include "engine/tools/small_tets.hpp"

namespace heml::contact_travel_test {

using namespace heml::test;

namespace {

using Positions = ContactSkin::Positions;

/// Two tetrahedra that share a face, and one away from them.
struct Bodies {
  TetMesh mesh;
  ContactSkin skin;

  static TetMesh make() {
    TetMesh mesh;
    add_tet(mesh, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)});
    mesh.nodes.emplace_back(1, 1, 1);
    mesh.tets.push_back({1, 2, 3, 4});
    add_tet(mesh, {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(5, 1, 0), Vec3(5, 0, 1)});
    return mesh;
  }
  Bodies() : mesh(make()), skin(mesh) {}
};

}  // namespace

TEST_CASE("contact travel: bodies that move as they are travel not within themselves, but against each other") {
  const Bodies two;
  REQUIRE(two.skin.bodies().size() == 2);
  CHECK(two.skin.body_of(0) == two.skin.body_of(4));
  CHECK(two.skin.body_of(4) != two.skin.body_of(5));
  Positions moved = two.skin.rest();
  for (std::size_t n = 0; n < moved.size(); ++n) moved[n] += n < 5 ? Vec3(0, 0.5, 0) : Vec3(0, 0.5, 3);
  const ContactTravel travel = travel_between(two.skin, two.skin.rest(), moved);
  for (const double of_node : travel.of_node) CHECK(of_node == doctest::Approx(0).scale(1));
  CHECK(travel.of_bodies == doctest::Approx(1.5));
  CHECK(travel.largest() == doctest::Approx(1.5));
  CHECK(travel.of_pair(two.skin, {0, 1, 2, 3}, false) == doctest::Approx(0).scale(1));
  CHECK(travel.of_pair(two.skin, {0, 5, 6, 7}, false) == doctest::Approx(1.5));
}

TEST_CASE("contact travel: nodes come no nearer to each other than it says") {
  const Bodies two;
  std::mt19937_64 random(2);
  for (int round = 0; round < 50; ++round) {
    Positions from = two.skin.rest(), to = from;
    const Vec3 apart = random_vector(random, 2);
    for (std::size_t n = 0; n < from.size(); ++n) {
      from[n] += random_vector(random, 0.2);
      to[n] += random_vector(random, 0.2) + (n < 5 ? apart : Vec3(Vec3::Zero()));
    }
    const ContactTravel travel = travel_between(two.skin, from, to);
    for (int a = 0; a < 9; ++a)
      for (int b = 0; b < a; ++b) {
        const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
        const double change = (to[i] - to[j] - from[i] + from[j]).norm();
        CHECK(change <= 2 * travel.of_pair(two.skin, {a, a, b, b}, true) * (1 + 1e-12));
        CHECK(change <= 2 * travel.of_each(two.skin, {a, a, b, b}) * (1 + 1e-12));
      }
    CHECK(travel.is_within(travel));
    ContactTravel most = travel;
    most.add(travel, 1e-12);  // round-off
    const auto largest = travel_within(two.skin, from, to, most);
    REQUIRE(largest);
    CHECK(*largest == doctest::Approx(travel.largest()));
    ContactTravel less = travel;
    less.of_node[3] *= 0.99;
    CHECK(!travel.is_within(less));
    CHECK(!travel_within(two.skin, from, to, less));
    less = travel;
    less.of_bodies *= 0.99;
    CHECK(!travel.is_within(less));
    CHECK(!travel_within(two.skin, from, to, less));
  }
}

TEST_CASE("contact travel: from no positions, and within nothing known, there is none") {
  const Bodies two;
  const ContactTravel none = travel_between(two.skin, {}, two.skin.rest());
  CHECK(none.of_node.empty());
  CHECK(!none.is_within(none));
  CHECK(!travel_within(two.skin, {}, two.skin.rest(), none));
  CHECK(!travel_within(two.skin, two.skin.rest(), two.skin.rest(), none));
}

TEST_CASE("contact travel: the largest at a node and those of its faces") {
  const Bodies two;
  std::vector<double> of_node(9, 1);
  of_node[4] = 7;  // shares faces with 1, 2 and 3
  CHECK(with_neighbours(two.skin, of_node) == std::vector<double>{1, 7, 7, 7, 7, 1, 1, 1, 1});
}

}  // namespace heml::contact_travel_test
