#include <doctest/doctest.h>

#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/surface.hpp>

namespace heml::generate_test {

TEST_CASE("a box of 4 cells a side has 125 nodes, 320 tetrahedra and the volume of the box") {
  TetMesh box = make_box(Vec3(0.1, 0.2, 0.3), {4, 4, 4}, Vec3(1, 2, 3));
  CHECK(box.nodes.size() == 125);
  CHECK(box.tets.size() == 320);
  CHECK(box.regions == std::vector<int>(320, 0));
  const QualityReport report = check_tets(box);
  CHECK(report.flipped == 0);
  CHECK(report.volume == doctest::Approx(0.1 * 0.2 * 0.3).epsilon(1e-13));
  CHECK(report.warnings.empty());
}

TEST_CASE("nodes of a box run x fastest, then y, then z, and end at the far corner exactly") {
  const Vec3 size(0.1, 0.2, 0.3), origin(0.5, 0, -1);
  const TetMesh box = make_box(size, {3, 2, 5}, origin);
  REQUIRE(box.nodes.size() == 4 * 3 * 6);
  CHECK(box.nodes[0] == origin);
  CHECK(box.nodes[3] == origin + Vec3(0.1, 0, 0));
  CHECK(box.nodes[8] == origin + Vec3(0, 0.2, 0));
  CHECK(box.nodes[12 * 5] == origin + Vec3(0, 0, 0.3));
  CHECK(box.nodes.back() == origin + size);
}

TEST_CASE("cells of a box fit: its boundary is the six sides, two triangles a cell face") {
  const TetMesh box = make_box(Vec3(1, 1, 1), {3, 2, 4});
  CHECK(extract_boundary(box).triangles.size() == 2 * 2 * (3 * 2 + 2 * 4 + 3 * 4));
}

TEST_CASE("each cell of a box is one tetrahedron of a third and four of a sixth of it") {
  for (const Vec3& size : {Vec3(1, 1, 1), Vec3(2, 1, 1)}) {
    const TetMesh box = make_box(size, {2, 1, 1});
    const double cell = size.prod() / 2;
    for (std::size_t t = 0; t < box.tets.size(); ++t) {
      const auto& [a, b, c, d] = box.tets[t];
      const double share = signed_volume(box.nodes[a], box.nodes[b], box.nodes[c], box.nodes[d]) / cell;
      CHECK(share == doctest::Approx(t % 5 == 0 ? 1.0 / 3 : 1.0 / 6).epsilon(1e-14));
    }
  }
}

TEST_CASE("refuses boxes without size, without cells or with too many") {
  CHECK_THROWS_AS(make_box(Vec3(1, 0, 1), {1, 1, 1}), InputError);
  CHECK_THROWS_AS(make_box(Vec3(1, 1, std::nan("")), {1, 1, 1}), InputError);
  CHECK_THROWS_AS(make_box(Vec3(1, 1, 1), {1, 0, 1}), InputError);
  CHECK_THROWS_AS(make_box(Vec3(1, 1, 1), {2000000000, 2000000000, 2000000000}), InputError);
}

}  // namespace heml::generate_test
