#include <doctest/doctest.h>

#include <heml/mesh/generate.hpp>
#include <heml/scenario/mesh_findings.hpp>

namespace heml::mesh_findings_test {

namespace {

using Finding = BareMeshChoices::Finding;

std::vector<Finding> findings_in(const TetMesh& mesh) {
  TetMesh checked = mesh;
  const QualityReport report = check_tets(checked);
  return findings_of(mesh, report, nullptr);
}

std::string line(const Finding& finding) {
  return std::to_string(finding.count) + " " + finding.found + ": " + finding.done +
         (finding.is_mended ? "" : " (not mended)");
}

std::vector<std::string> lines(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) all.push_back(line(finding));
  return all;
}

using Lines = std::vector<std::string>;

/// A node of the middle is pushed past its neighbours.
TetMesh tangled_box() {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {4, 4, 4});
  for (Vec3& x : mesh.nodes)
    if (x.isApprox(Vec3(0.5, 0.5, 0.5))) x.x() += 0.27;
  return mesh;
}

}  // namespace

TEST_CASE("a good mesh has no findings") { CHECK(findings_in(make_box(Vec3(1, 1, 1), {2, 2, 2})).empty()); }

TEST_CASE("each repair of a surface is a finding with its count") {
  MendReport report;
  report.welded = 3;
  report.flat = 1;
  report.duplicates = 2;
  report.split = 1;
  report.crumbs = {4, 40, 0.001};
  report.walls = {1, 12, 0};
  report.holes.holes = 5;
  report.holes.sheets = 1;
  report.turned = 7;
  report.smoothed = 6;
  CHECK(lines(findings_of(report)) ==
        Lines{"3 double nodes: merged", "1 flat triangle: removed", "2 double triangles: removed",
              "1 T-junction: edges split", "4 loose parts: left out", "1 inner wall: left out", "1 sheet: left out",
              "5 holes: closed", "7 triangles turned inward: turned", "6 self-intersections: smoothed apart"});
  CHECK(findings_of(MendReport()).empty());
}

TEST_CASE("what no repair of triangles mends is told by its kind") {
  MendReport report;
  report.unmended = "it is open";
  CHECK(lines(findings_of(report)) == Lines{"1 surface not closed: meshed anew"});
  report.crossings = 12;
  CHECK(lines(findings_of(report)) == Lines{"12 self-intersections: meshed anew"});
  CHECK(findings_of(report)[0].detail.find("it is open") != std::string::npos);
}

TEST_CASE("slivers are counted with their thinnest angle, before and after") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {2, 2, 2});
  const Tet& tet = mesh.tets[0];
  const Vec3 middle = (mesh.nodes[tet[0]] + mesh.nodes[tet[1]] + mesh.nodes[tet[2]]) / 3;
  mesh.nodes[tet[3]] += 0.98 * (middle - mesh.nodes[tet[3]]);
  const QualityReport report = check_tets(mesh);
  REQUIRE(report.slivers > 0);
  const auto kept = findings_of(mesh, report, nullptr);
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].count == report.slivers);
  CHECK(kept[0].done.starts_with("kept, thinnest "));
  CHECK_FALSE(kept[0].is_mended);
  QualityReport improved = report;
  improved.slivers = 0;
  CHECK(findings_of(mesh, report, &improved)[0].done == "improved");
  CHECK(findings_of(mesh, report, &improved)[0].is_mended);
  improved.slivers = 2;
  CHECK(findings_of(mesh, report, &improved)[0].done == "2 left");
  CHECK_FALSE(findings_of(mesh, report, &improved)[0].is_mended);
}

TEST_CASE("inverted elements are told from such as list their nodes in the other order") {
  TetMesh wound = make_box(Vec3(1, 1, 1), {2, 2, 2});
  for (std::size_t t = 0; t < 3; ++t) std::swap(wound.tets[t][0], wound.tets[t][1]);
  CHECK(lines(findings_in(wound)) == Lines{"3 elements wound inward: reordered"});
  const TetMesh tangled = tangled_box();
  int inverted = 0;
  for (const Tet& t : tangled.tets)
    inverted += signed_volume(tangled.nodes[t[0]], tangled.nodes[t[1]], tangled.nodes[t[2]], tangled.nodes[t[3]]) < 0;
  REQUIRE(inverted > 0);
  const auto found = findings_in(tangled);
  REQUIRE(!found.empty());
  CHECK(line(found[0]) == std::to_string(inverted) + " inverted elements: turned over (not mended)");
}

TEST_CASE("separate bodies, double and lone nodes are told") {
  TetMesh mesh = make_box(Vec3(1, 1, 1), {1, 1, 1});
  const TetMesh other = make_box(Vec3(1, 1, 1), {1, 1, 1}, Vec3(2, 0, 0));
  const int first = static_cast<int>(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (Tet tet : other.tets) {
    for (int& node : tet) node += first;
    mesh.tets.push_back(tet);
  }
  mesh.regions.assign(mesh.tets.size(), 0);
  mesh.nodes.emplace_back(5, 5, 5);
  CHECK(lines(findings_in(mesh)) == Lines{"2 separate bodies: kept (not mended)", "1 lone node: kept (not mended)"});
}

}  // namespace heml::mesh_findings_test
