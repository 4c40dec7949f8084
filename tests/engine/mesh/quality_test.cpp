#include <doctest/doctest.h>

#include <cmath>
#include <heml/base/error.hpp>
#include <heml/mesh/generate.hpp>
#include <heml/mesh/quality.hpp>
#include <limits>
#include <numbers>
#include <string>

namespace heml::quality_test {

namespace {
TetMesh corner() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}}, {0}, "corner"}; }

std::string refusal(TetMesh mesh) {
  try {
    check_tets(mesh);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
}  // namespace

TEST_CASE("measures a regular tetrahedron: dihedral angle acos 1/3, volume 1/(6√2), edges 1") {
  const double s = std::sqrt(0.125);  // half the side of the cube whose diagonals are the edges
  TetMesh mesh{{{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {{0, 1, 2, 3}}, {7}, ""};
  const QualityReport report = check_tets(mesh);
  CHECK(report.worst_dihedral == doctest::Approx(std::acos(1.0 / 3) * 180 / std::numbers::pi).epsilon(1e-13));
  CHECK(report.volume == doctest::Approx(1 / (6 * std::sqrt(2.0))).epsilon(1e-13));
  CHECK(report.shortest_edge == doctest::Approx(1).epsilon(1e-14));
  CHECK(report.longest_edge == doctest::Approx(1).epsilon(1e-14));
  CHECK(report.worst_tet == 0);
  CHECK(report.components == 1);
}

TEST_CASE("repairs winding and says how many") {
  TetMesh box = make_box(Vec3(1, 1, 1), {2, 2, 2});
  for (int t : {3, 17, 30}) std::swap(box.tets[t][0], box.tets[t][1]);
  const QualityReport report = check_tets(box);
  CHECK(report.flipped == 3);
  REQUIRE(report.warnings.size() == 1);
  CHECK(report.warnings[0].find("3 of 40") != std::string::npos);
  for (const auto& [a, b, c, d] : box.tets)
    CHECK(signed_volume(box.nodes[a], box.nodes[b], box.nodes[c], box.nodes[d]) > 0);
  CHECK(report.volume == doctest::Approx(1).epsilon(1e-13));
}

TEST_CASE("counts orphans, duplicates, bodies and regions without changing the nodes") {
  TetMesh mesh = corner();
  mesh.nodes.insert(mesh.nodes.end(), {{5, 5, 5}, {1, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}});
  mesh.tets.push_back({5, 6, 7, 8});
  mesh.regions = {1, 4};
  const std::vector<Vec3> before = mesh.nodes;
  const QualityReport report = check_tets(mesh);
  CHECK(report.orphans == 1);
  CHECK(report.duplicates == 1);
  CHECK(report.components == 2);
  CHECK(report.regions == 2);
  CHECK(report.warnings.size() == 3);
  CHECK(mesh.nodes == before);
  CHECK(report.high == Vec3(2, 1, 1));  // the orphan does not count
}

TEST_CASE("finds the worst of the slivers") {
  TetMesh mesh = corner();
  mesh.nodes.insert(mesh.nodes.end(), {{0.3, 0.3, -0.02}, {1, 1, 0.01}});
  mesh.tets.push_back({0, 2, 1, 4});
  mesh.tets.push_back({0, 1, 2, 5});
  mesh.regions.assign(3, 0);
  const QualityReport report = check_tets(mesh);
  CHECK(report.slivers == 2);
  CHECK(report.worst_tet == 2);
  CHECK(report.worst_dihedral < 1);
}

TEST_CASE("counts boundary edges where parts hang together by the edge alone") {
  TetMesh mesh{
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 2, 3, 1}, {0, 4, 5, 1}}, {0, 0}, ""};
  CHECK(check_tets(mesh).nonmanifold_edges == 1);
}

TEST_CASE("says when elements are given twice") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  for (int copy = 0; copy < 2; ++copy) {
    mesh.tets.push_back(mesh.tets[0]);
    mesh.regions.push_back(0);
  }
  bool said = false;
  for (const std::string& warning : check_tets(mesh).warnings)
    said = said || warning.find("twice") != std::string::npos;
  CHECK(said);
}

TEST_CASE("refuses an element of no volume, flat or tilted, small or large, and names it and its nodes") {
  for (double scale : {1e-6, 1.0, 1e6}) {
    TetMesh mesh = corner();
    for (Vec3& x : mesh.nodes) x *= scale;
    mesh.nodes.push_back(scale * Vec3(1, 1, 1) / 3);  // on the plane of nodes 1, 2, 3
    mesh.tets.push_back({1, 2, 3, 4});
    mesh.regions.push_back(0);
    const std::string said = refusal(mesh);
    CHECK(said.find("element 1") != std::string::npos);
    CHECK(said.find("1, 2, 3, 4") != std::string::npos);
  }
}

TEST_CASE("accepts flat elements whose volume is real") {
  TetMesh mesh = corner();
  mesh.nodes[3] = Vec3(0.3, 0.3, 1e-9);
  CHECK(check_tets(mesh).slivers == 1);
}

TEST_CASE("refuses what cannot be repaired and names the element or node") {
  TetMesh mesh = corner();
  mesh.tets[0][2] = 4;
  CHECK(refusal(mesh).find("element 0: names node 4") != std::string::npos);
  mesh.tets[0][2] = -1;
  CHECK(refusal(mesh).find("element 0: names node -1") != std::string::npos);
  mesh.tets[0][2] = 1;
  CHECK(refusal(mesh).find("element 0: has node 1 twice") != std::string::npos);
  mesh = corner();
  mesh.nodes[2][1] = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(mesh).find("node 2") != std::string::npos);
  mesh.nodes[2][1] = 1e200;
  CHECK(refusal(mesh).find("node 2") != std::string::npos);
  mesh = corner();
  mesh.tets.clear();
  mesh.regions.clear();
  CHECK(refusal(mesh).find("no tetrahedra") != std::string::npos);
}

TEST_CASE("the report in words holds counts, volume and every warning") {
  TetMesh mesh = corner();
  mesh.nodes.emplace_back(3, 3, 3);
  const std::string text = to_text(check_tets(mesh));
  CHECK(text.find("5 nodes, 1 tetrahedra, 1 region\n") != std::string::npos);
  CHECK(text.find("0.166667 m³") != std::string::npos);
  CHECK(text.find("warning: 1 node of no tetrahedron") != std::string::npos);
}

}  // namespace heml::quality_test
