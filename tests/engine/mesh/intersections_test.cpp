#include <doctest/doctest.h>

#include <heml/mesh/intersections.hpp>

#include "engine/mesh/solids.hpp"
#include "support.hpp"

namespace heml::intersections_test {

namespace {

std::size_t pairs(const std::vector<Vec3>& nodes, const std::vector<Triangle>& triangles) {
  return self_intersections({nodes, triangles, ""}).pairs;
}

// Whether triangle (0,0,0) (1,0,0) (0,1,0) meets triangle abc, without shared nodes.
bool meets(const Vec3& a, const Vec3& b, const Vec3& c) {
  return pairs({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a, b, c}, {{0, 1, 2}, {3, 4, 5}}) == 1;
}

// Whether it meets the triangle of its node 0, a and b.
bool meets_at_corner(const Vec3& a, const Vec3& b) {
  return pairs({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, a, b}, {{0, 1, 2}, {3, 0, 4}}) == 1;
}

}  // namespace

TEST_CASE("triangles through each other, apart, and behind each other") {
  CHECK(meets({0.2, 0.2, -1}, {0.2, 0.2, 1}, {0.3, 5, 0}));
  CHECK_FALSE(meets({0.2, 0.2, 0.1}, {0.2, 0.2, 1}, {0.3, 5, 0.5}));
  CHECK_FALSE(meets({0.8, 0.8, -1}, {0.8, 0.8, 1}, {5, 5, 0}));
}

TEST_CASE("a corner on a side, an edge on an edge: touching counts") {
  CHECK(meets({0.25, 0.25, 0}, {0.25, 0.25, 1}, {0.5, 0.25, 1}));
  CHECK(meets({0.5, -1, -1}, {0.5, 1, 1}, {0.5, -1, 1}));
  CHECK_FALSE(meets({0.25, 0.25, 1e-12}, {0.25, 0.25, 1}, {0.5, 0.25, 1}));
}

TEST_CASE("triangles in one plane: overlapping, one in the other, apart") {
  CHECK(meets({0.5, 0.25, 0}, {2, 0, 0}, {2, 2, 0}));
  CHECK(meets({0.1, 0.1, 0}, {0.2, 0.1, 0}, {0.1, 0.2, 0}));
  CHECK(meets({-5, -5, 0}, {9, -5, 0}, {-5, 9, 0}));
  CHECK_FALSE(meets({0.6, 0.6, 0}, {2, 0.6, 0}, {2, 2, 0}));
}

TEST_CASE("triangles at one corner: spread, one through the other, one on the other") {
  CHECK_FALSE(meets_at_corner({-1, 0, 0}, {0, -1, 0}));
  CHECK_FALSE(meets_at_corner({0.5, 0.5, 1}, {0.5, 0.4, 1}));
  CHECK(meets_at_corner({0.5, 0.4, 0.1}, {0.5, 0.4, -0.1}));
  CHECK(meets_at_corner({2, 1, 0}, {1, 2, 0}));      // beyond the opposite edge, in the plane
  CHECK(meets_at_corner({0.2, 0.1, 0}, {1, 1, 5}));  // an edge within the other triangle
}

TEST_CASE("triangles at one edge meet only when folded flat") {
  const std::vector<Triangle> at_edge{{0, 1, 2}, {1, 0, 3}};
  CHECK(pairs({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, -1, 0}}, at_edge) == 0);
  CHECK(pairs({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 1, 1e-9}}, at_edge) == 0);
  CHECK(pairs({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 2, 0}}, at_edge) == 1);
}

TEST_CASE("a proper surface has none, fine or coarse, near or far from the origin") {
  for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(1e3, -2e3, 1e2)})
    CHECK(self_intersections(box_surface({0.3, 0.1, 0.7}, 9, origin)).pairs == 0);
}

TEST_CASE("finds the pairs that comparing every two triangles alone finds") {
  std::mt19937_64 random(11);
  TriangleMesh soup;
  for (int t = 0; t < 200; ++t) {
    const Vec3 centre = test::random_vector(random, 1);
    for (int i = 0; i < 3; ++i) soup.nodes.push_back(centre + test::random_vector(random, 0.3));
    soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  std::size_t count = 0;
  std::pair first(-1, -1);
  for (int s = 0; s < 200; ++s)
    for (int t = s + 1; t < 200; ++t) {
      if (pairs(soup.nodes, {soup.triangles[s], soup.triangles[t]}) == 0) continue;
      if (count++ == 0) first = {s, t};
    }
  const Intersections found = self_intersections(soup);
  CHECK(count > 50);
  CHECK(found.pairs == count);
  CHECK(std::pair(found.first, found.second) == first);
}

}  // namespace heml::intersections_test
