#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/mesh/improve/improve.hpp>
#include <heml/mesh/quality.hpp>

#include "engine/mesh/improve/bodies.hpp"

namespace heml::improve_test {
namespace {

double worst_angle(TetMesh mesh) { return check_tets(mesh).worst_dihedral; }

/// A ball of 0.1 m: the nodes of a cube moved outward or inward.
TetMesh ball(int cells, double amount) {
  TetMesh mesh = make_box(Vec3::Constant(2), {cells, cells, cells}, Vec3::Constant(-1));
  std::mt19937_64 random(2);
  for (Vec3& x : mesh.nodes) {
    const double size = x.cwiseAbs().maxCoeff();
    if (size < 0.999) x += test::random_vector(random, amount * 2 / cells);
    if (x.norm() > 0) x *= 0.05 * x.cwiseAbs().maxCoeff() / x.norm();
  }
  return mesh;
}

}  // namespace

TEST_CASE("slivers go, and the body, its regions and its interface stay") {
  TetMesh before = test::shaken_box(6, 0.45);
  before.region_names = {{0, "liver"}};
  REQUIRE(worst_angle(before) < 5);
  const Improvement improved = improve(before);
  CHECK(improved.below.empty());
  CHECK(worst_angle(improved.mesh) >= 10);
  CHECK(improved.surface_distance < 1e-12);
  test::check_same_body(before, improved.mesh);
  CHECK(improved.mesh.region_names == before.region_names);
}

TEST_CASE("improving is deterministic") {
  const TetMesh before = test::shaken_box(4, 0.45);
  const TetMesh a = improve(before).mesh, b = improve(before).mesh;
  CHECK(a.nodes == b.nodes);
  CHECK(a.tets == b.tets);
}

TEST_CASE("a curved surface stays within the tolerance") {
  const TetMesh before = ball(6, 0.15);
  ImproveOptions options;
  options.surface_tolerance = 0.001;
  const Improvement improved = improve(before, options);
  CHECK(worst_angle(improved.mesh) >= 10);
  CHECK(improved.surface_distance <= 0.001);
  CHECK(test::volumes_of_regions(improved.mesh).at(0) ==
        doctest::Approx(test::volumes_of_regions(before).at(0)).epsilon(0.02));
}

TEST_CASE("a mesh is coarsened and refined to a wanted number of elements") {
  const TetMesh before = test::shaken_box(6, 0.2);
  for (const int tets : {400, 3000}) {
    ImproveOptions options;
    options.tets = tets;
    const Improvement improved = improve(before, options);
    CHECK(std::abs(static_cast<double>(improved.mesh.tets.size()) - tets) < 0.25 * tets);
    CHECK(worst_angle(improved.mesh) >= 10);
    test::check_same_body(before, improved.mesh);
  }
}

TEST_CASE("inverted elements are untangled") {
  TetMesh before = make_box(Vec3::Ones(), {3, 3, 3});
  const double volume = 1;
  before.nodes[1 + 4 + 16] += Vec3(0.5, 0.1, 0.05);
  const Improvement improved = improve(before);
  CHECK(improved.untangled > 0);
  CHECK(improved.below.empty());
  CHECK(test::volumes_of_regions(improved.mesh).at(0) == doctest::Approx(volume));
}

// Two elements on the same side of their common face; all nodes are corners of the surface.
TEST_CASE("an inversion that nothing mends is refused by number") {
  const TetMesh two{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {2, 2, 0.5}}, {{0, 1, 2, 3}, {0, 2, 1, 4}}, {0, 0}, "folded.msh"};
  CHECK_THROWS_WITH_AS(
      improve(two),
      "folded.msh: element 1: 1 inverted or flat elements (1), of which 1 could not be untangled (mesh "
      "its surface anew: heml mesh SURFACE)",
      InputError);
}

TEST_CASE("several bodies are improved alike") {
  TetMesh before = test::shaken_box(4, 0.45);
  const TetMesh other = test::shaken_box(4, 0.45, 9);
  const int first = static_cast<int>(before.nodes.size());
  for (const Vec3& x : other.nodes) before.nodes.push_back(x + Vec3(0.5, 0, 0));
  for (const auto& [a, b, c, d] : other.tets) before.tets.push_back({a + first, b + first, c + first, d + first});
  before.regions.insert(before.regions.end(), other.regions.begin(), other.regions.end());
  const Improvement improved = improve(before);
  CHECK(improved.below.empty());
  test::check_same_body(before, improved.mesh);
}

}  // namespace heml::improve_test
