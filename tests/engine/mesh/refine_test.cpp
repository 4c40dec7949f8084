#include <doctest/doctest.h>

#include <heml/mesh/faces.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quality.hpp>
#include <heml/mesh/refine.hpp>
#include <map>
#include <numeric>
#include <set>

namespace heml::refine_test {

namespace {

double volume_of(const TetMesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t a) { return mesh.nodes[static_cast<std::size_t>(mesh.tets[t][a])]; };
  return signed_volume(at(0), at(1), at(2), at(3));
}

/// Area of the faces of exactly one element: the area of the box, unless there are gaps or hanging nodes.
double outside_area(const TetMesh& mesh) {
  std::map<std::set<int>, int> faces;
  for (const Tet& tet : mesh.tets)
    for (std::size_t a = 0; a < 4; ++a) ++faces[{tet[(a + 1) % 4], tet[(a + 2) % 4], tet[(a + 3) % 4]}];
  double area = 0;
  for (const auto& [face, count] : faces) {
    CHECK(count <= 2);
    if (count == 2) continue;
    std::vector<Vec3> x;
    for (const int n : face) x.push_back(mesh.nodes[static_cast<std::size_t>(n)]);
    area += (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2;
  }
  return area;
}

TetMesh sample() {
  TetMesh mesh = make_box(Vec3(2, 1, 1.5), {3, 2, 2});
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) mesh.regions[t] = static_cast<int>(t % 3);
  mesh.fields = {{"k", 1, std::vector<double>(mesh.tets.size())}};
  std::iota(mesh.fields[0].values.begin(), mesh.fields[0].values.end(), 0.0);
  return mesh;
}

/// The `count` elements nearest to the origin, a corner of the box.
std::vector<int> near_corner(const TetMesh& mesh, std::size_t count) {
  std::vector<double> nearness;
  for (const Tet& tet : mesh.tets) {
    Vec3 centre = Vec3::Zero();
    for (const int n : tet) centre += mesh.nodes[static_cast<std::size_t>(n)] / 4;
    nearness.push_back(1 / centre.norm());
  }
  std::vector<int> order(nearness.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return nearness[static_cast<std::size_t>(a)] > nearness[static_cast<std::size_t>(b)];
  });
  order.resize(count);
  return order;
}

}  // namespace

TEST_CASE(
    "pieces of a refined mesh fill their parents, with their region and fields, and midpoints lie in the middle of "
    "edges") {
  const TetMesh mesh = sample();
  const std::vector<int> chosen{0, 7, 31};
  const Refinement finer = refine_longest_edge(mesh, chosen);
  REQUIRE(finer.parents.size() == finer.mesh.tets.size());
  CHECK(finer.mesh.tets.size() > mesh.tets.size() + 2);
  CHECK(finer.mesh.tets.size() < 2 * mesh.tets.size());
  std::vector<double> volume(mesh.tets.size(), 0.0);
  std::vector<int> pieces(mesh.tets.size(), 0);
  for (std::size_t t = 0; t < finer.mesh.tets.size(); ++t) {
    const auto parent = static_cast<std::size_t>(finer.parents[t]);
    CHECK(volume_of(finer.mesh, t) > 0);
    volume[parent] += volume_of(finer.mesh, t);
    ++pieces[parent];
    CHECK(finer.mesh.regions[t] == mesh.regions[parent]);
    CHECK(finer.mesh.fields[0].values[t] == static_cast<double>(parent));
  }
  for (std::size_t t = 0; t < volume.size(); ++t)
    CHECK(volume[t] == doctest::Approx(volume_of(mesh, t)).epsilon(1e-12));
  for (const int t : chosen) CHECK(pieces[static_cast<std::size_t>(t)] >= 2);
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) CHECK(finer.mesh.nodes[n] == mesh.nodes[n]);
  for (std::size_t m = 0; m < finer.midpoint_edges.size(); ++m) {
    const auto [a, b] = finer.midpoint_edges[m];
    const Vec3 middle = (mesh.nodes[static_cast<std::size_t>(a)] + mesh.nodes[static_cast<std::size_t>(b)]) / 2;
    CHECK((finer.mesh.nodes[mesh.nodes.size() + m] - middle).norm() == 0);
  }
}

TEST_CASE("a mesh refined again and again at a corner conforms, stays local, and its shapes do not degenerate") {
  TetMesh mesh = sample();
  const double area = outside_area(mesh);
  const double shape = check_tets(mesh).worst_dihedral;
  for (int round = 0; round < 12; ++round) {
    mesh = refine_longest_edge(mesh, near_corner(mesh, 8)).mesh;
    CHECK(outside_area(mesh) == doctest::Approx(area).epsilon(1e-12));
  }
  const QualityReport report = check_tets(mesh);
  CHECK(report.volume == doctest::Approx(3).epsilon(1e-12));
  CHECK(report.flipped == 0);
  CHECK(report.worst_dihedral > shape / 4);
  CHECK(report.shortest_edge < report.longest_edge / 10);
  CHECK(mesh.tets.size() < 3000);
}

TEST_CASE("nothing chosen changes nothing, all chosen halves all at least") {
  const TetMesh mesh = sample();
  CHECK(refine_longest_edge(mesh, {}).mesh.tets == mesh.tets);
  std::vector<int> all(mesh.tets.size());
  std::iota(all.begin(), all.end(), 0);
  CHECK(refine_longest_edge(mesh, all).mesh.tets.size() >= 2 * mesh.tets.size());
}

TEST_CASE("the fewest elements that have the requested share of the sum are marked") {
  CHECK(doerfler_marking({1, 5, 2, 2}, 0.5) == std::vector<int>{1});
  CHECK(doerfler_marking({1, 5, 2, 2}, 0.6) == std::vector<int>{1, 2});
  CHECK(doerfler_marking({1, 5, 2, 2}, 1) == std::vector<int>{0, 1, 2, 3});
  CHECK(doerfler_marking({0, 0}, 0.5).empty());
}

}  // namespace heml::refine_test
