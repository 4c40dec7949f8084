#include "app/render/section_cut.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <heml/mesh/generate.hpp>

namespace heml::section_cut_test {

using namespace heml::render;

namespace {

// A box of 1 × 2 × 3 m in tetrahedra.
Solid box() {
  const TetMesh mesh = make_box(Vec3(1, 2, 3), {3, 4, 5});
  Solid solid;
  for (const Vec3& node : mesh.nodes) solid.rest.push_back(node.cast<float>());
  solid.tets = mesh.tets;
  solid.regions.assign(mesh.tets.size(), 0);
  return solid;
}

// Sum of the triangles' normals times their areas.
Vec3f area_vector(const std::vector<SectionTriangle>& triangles, const std::vector<Vec3f>& positions) {
  Vec3f sum = Vec3f::Zero();
  for (const SectionTriangle& triangle : triangles) {
    const Vec3f a = at_corner(triangle.corners[0], positions), b = at_corner(triangle.corners[1], positions),
                c = at_corner(triangle.corners[2], positions);
    sum += (b - a).cross(c - a) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("the cross-section of a box has its area and faces what is left out") {
  const Solid solid = box();
  for (const float at : {0.1f, 0.47f, 0.9f}) {
    const Vec3f area = area_vector(cut_section(solid, solid.rest, {Vec3f::UnitX(), at}), solid.rest);
    CHECK((area - Vec3f(6, 0, 0)).norm() < 1e-4f);
  }
  const Vec3f slanted = Vec3f(0, -1, -1).normalized();  // y + z = 2.5: a rectangle 1 × 2√2
  const Vec3f area = area_vector(cut_section(solid, solid.rest, {slanted, -2.5f / std::sqrt(2.0f)}), solid.rest);
  CHECK((area - 2 * std::sqrt(2.0f) * slanted).norm() < 1e-4f);
}

TEST_CASE("a deformed body is cut where it is") {
  const Solid solid = box();
  std::vector<Vec3f> positions = solid.rest;
  for (Vec3f& x : positions) x = Vec3f(x.x() + 10, 2 * x.y(), x.z());
  CHECK(cut_section(solid, positions, {Vec3f::UnitX(), 0.5f}).empty());
  const Vec3f area = area_vector(cut_section(solid, positions, {Vec3f::UnitX(), 10.5f}), positions);
  CHECK((area - Vec3f(12, 0, 0)).norm() < 1e-3f);
}

TEST_CASE("corners lie on the plane and carry linear values exactly") {
  const Solid solid = box();
  const SectionPlane plane{Vec3f(1, 2, -1).normalized(), 0.7f};
  std::vector<float> values;
  for (const Vec3f& x : solid.rest) values.push_back(3 * x.x() - x.y() + 2 * x.z());
  const auto triangles = cut_section(solid, solid.rest, plane);
  REQUIRE(triangles.size() > 20);
  for (const SectionTriangle& triangle : triangles)
    for (const SectionCorner& corner : triangle.corners) {
      const Vec3f x = at_corner(corner, solid.rest);
      CHECK(std::abs(plane.beyond(x)) < 1e-5f);
      CHECK(at_corner(corner, values) == doctest::Approx(3 * x.x() - x.y() + 2 * x.z()).epsilon(1e-4));
    }
}

TEST_CASE("a plane beside the body, one through its face, and positions that are no numbers cut nothing wrong") {
  Solid solid = box();
  CHECK(cut_section(solid, solid.rest, {Vec3f::UnitX(), -1}).empty());
  CHECK(cut_section(solid, solid.rest, {Vec3f::UnitX(), 2}).empty());
  CHECK(cut_section(solid, solid.rest, {Vec3f::UnitX(), 1}).empty());
  std::vector<Vec3f> positions = solid.rest;
  for (Vec3f& x : positions) x.x() = std::nanf("");
  CHECK(cut_section(solid, positions, {Vec3f::UnitX(), 0.5f}).empty());
}

TEST_CASE("of a segment that crosses the plane the part on the shown side is left") {
  const SectionPlane plane{Vec3f::UnitX(), 0.25f};
  const Vec3f in(0, 0, 0), out(1, 2, 0), crossing(0.25f, 0.5f, 0);
  CHECK(part_left_in(std::nullopt, in, out) == std::array{in, out});
  CHECK(part_left_in(plane, in, out) == std::array{in, crossing});
  CHECK(part_left_in(plane, out, in) == std::array{crossing, in});
  CHECK_FALSE(part_left_in(plane, out, out));
  CHECK(is_left_out(plane, out));
  CHECK_FALSE(is_left_out(plane, in));
  CHECK_FALSE(is_left_out(std::nullopt, out));
}

}  // namespace heml::section_cut_test
