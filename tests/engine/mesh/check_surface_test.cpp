#include <doctest/doctest.h>
#include <fmt/format.h>

#include <heml/mesh/from_surface.hpp>
#include <limits>
#include <messages.hpp>

#include "engine/mesh/files.hpp"
#include "engine/mesh/solids.hpp"

namespace heml::check_surface_test {

namespace {
std::string refusal_of(TriangleMesh surface) {
  return refusal([&] { check_surface(surface); });
}
}  // namespace

TEST_CASE("turns scattered triangles outward") {
  TriangleMesh surface = cube(2, Vec3(5, 5, 5));
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3)
    std::swap(surface.triangles[t][0], surface.triangles[t][1]);
  check_surface(surface);
  CHECK(enclosed_volume(surface) == doctest::Approx(8).epsilon(1e-13));
}

TEST_CASE("turns the walls of a cavity into it, and a body in the cavity outward again") {
  TriangleMesh surface = together(together(cube(1, Vec3(9, 9, 9)), cube(3, Vec3(9, 9, 9))), cube(2, Vec3(9, 9, 9)));
  check_surface(surface);
  CHECK(enclosed_volume(surface) == doctest::Approx(27 - 8 + 1).epsilon(1e-13));
}

TEST_CASE("accepts separate bodies") {
  TriangleMesh surface = together(cube(1, Vec3(0, 0, 0)), cube(1, Vec3(1.001, 0, 0)));
  check_surface(surface);
  CHECK(enclosed_volume(surface) == doctest::Approx(2).epsilon(1e-13));
}

TEST_CASE("refuses an open surface: how many edges, and where one is") {
  TriangleMesh surface = cube(1, Vec3(0.5, 0.5, 0.5));
  const Triangle gone = surface.triangles.back();
  surface.triangles.pop_back();
  const std::string said = refusal_of(surface);
  CHECK(says(said, "the surface is open: 3 edges"));
  bool names_one = false;
  for (int node : gone) {
    const Vec3& x = surface.nodes[node];
    names_one = names_one || says(said, fmt::format("edge from [{}, {}, {}]", x[0], x[1], x[2]).c_str());
  }
  CHECK(names_one);
}

TEST_CASE("refuses edges of more than two triangles") {
  const TriangleMesh surface{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}},
                             {{0, 2, 1}, {0, 3, 2}, {1, 2, 3}, {0, 1, 3}, {0, 4, 1}, {0, 5, 4}, {1, 4, 5}, {0, 1, 5}},
                             ""};
  CHECK(says(refusal_of(surface), "1 edges have more than two triangles"));
}

TEST_CASE("refuses triangles given twice, in any order of corners") {
  TriangleMesh surface = cube(1, Vec3(0, 0, 0));
  const auto [a, b, c] = surface.triangles[5];
  surface.triangles.push_back({c, a, b});
  surface.triangles.push_back({b, a, c});
  CHECK(says(refusal_of(surface), "lies on triangle 5; 2 such"));
}

TEST_CASE("refuses a surface of one side only") {
  // The projective plane of six vertices (half an icosahedron), in general position.
  TriangleMesh surface{
      {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, 0.1}, {0.1, 0.3, 1}, {1, 0.9, 0.4}, {0.7, 0.2, 1.1}},
      {{0, 1, 2}, {0, 1, 3}, {0, 2, 4}, {0, 3, 5}, {0, 4, 5}, {1, 2, 5}, {1, 3, 4}, {1, 4, 5}, {2, 3, 4}, {2, 3, 5}},
      ""};
  CHECK(says(refusal_of(surface), "one side only"));
}

TEST_CASE("refuses bodies that cross: which triangles, how many pairs") {
  const std::string said = refusal_of(together(cube(1, Vec3(0, 0, 0)), cube(1, Vec3(0.3, 0.31, 0.32))));
  CHECK(says(said, "meets triangle"));
  CHECK(says(said, "pairs of triangles"));
}

TEST_CASE("refuses bodies that touch") {
  CHECK(says(refusal_of(together(cube(1, Vec3(0, 0, 0)), cube(1, Vec3(1, 0.1, 0.1)))), "meets triangle"));
}

TEST_CASE("refuses what is no surface at all") {
  TriangleMesh surface = cube(1, Vec3(0, 0, 0));
  surface.triangles[7][1] = 999;
  CHECK(says(refusal_of(surface), "triangle 7: names node 999"));
  surface = cube(1, Vec3(0, 0, 0));
  surface.nodes[3][2] = std::numeric_limits<double>::quiet_NaN();
  CHECK(says(refusal_of(surface), "node 3"));
  surface = cube(1, Vec3(0, 0, 0));
  surface.triangles[4][1] = surface.triangles[4][0];
  CHECK(says(refusal_of(surface), "triangle 4: has no area"));
  CHECK(says(refusal_of({}), "no triangles"));
}

}  // namespace heml::check_surface_test
