#include <doctest/doctest.h>

#include <heml/mesh/faces.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/subdivide.hpp>
#include <numeric>

namespace heml::subdivide_test {

namespace {
double volume_of(const TetMesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(mesh.tets[t][a])]; };
  return signed_volume(at(0), at(1), at(2), at(3));
}
}  // namespace

TEST_CASE("a subdivided mesh has the same volume in eighths, old nodes first, then midpoints of edges") {
  TetMesh mesh = make_box(Vec3(2, 1, 1.5), {3, 2, 2});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = static_cast<int>(t % 3);
  mesh.fields = {{"k", 1, std::vector<double>(mesh.tets.size())}};
  std::iota(mesh.fields[0].values.begin(), mesh.fields[0].values.end(), 0.0);
  const Subdivision finer = subdivide_uniformly(mesh);
  REQUIRE(finer.mesh.tets.size() == 8 * mesh.tets.size());
  REQUIRE(finer.mesh.nodes.size() == mesh.nodes.size() + finer.midpoint_edges.size());
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) CHECK(finer.mesh.nodes[n] == mesh.nodes[n]);
  for (std::size_t m = 0; m < finer.midpoint_edges.size(); ++m) {
    const auto [a, b] = finer.midpoint_edges[m];
    const Vec3 middle = (mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2;
    CHECK((finer.mesh.nodes[mesh.nodes.size() + m] - middle).norm() == 0);
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (std::size_t child = 8 * t; child < 8 * t + 8; ++child) {
      CHECK(volume_of(finer.mesh, child) == doctest::Approx(volume_of(mesh, t) / 8).epsilon(1e-12));
      CHECK(finer.mesh.regions[child] == mesh.regions[t]);
      CHECK(finer.mesh.fields[0].values[child] == static_cast<double>(t));
    }
}

TEST_CASE("a subdivided mesh has no gaps, and twice subdivided its shapes are no worse than once") {
  const TetMesh mesh = make_box(Vec3(1, 1, 1), {2, 2, 2});
  TetMesh once = subdivide_uniformly(mesh).mesh, twice = subdivide_uniformly(once).mesh;
  for (TetMesh* finer : {&once, &twice}) {
    const auto counts = face_counts(finer->tets, static_cast<int>(finer->nodes.size()));
    std::size_t outside = 0;
    for (const auto count : counts) {
      CHECK(count <= 2);
      outside += count == 1;
    }
    CHECK(outside == (finer == &once ? 4u : 16u) * 48);
  }
  CHECK(check_tets(twice).worst_dihedral == doctest::Approx(check_tets(once).worst_dihedral).epsilon(1e-6));
}

}  // namespace heml::subdivide_test
